"""The model that learns a correction, as a study uses it, and against a dense solve."""

import pickle

import numpy as np
import pytest
from scipy.linalg import cho_factor, cho_solve

from lad.command import Command
from lad.correction import CorrectionAssistant
from lad.errors import InvalidInputError, InvalidTargetError, ModelFileError
from lad.hyperparameters import LADParameters
from lad.kernel import recursive_kernel
from lad.lad_assistant import LADAssistant
from lad.stork_gp import StorkGP
from lad.stream import learn_stream
from lad.trained import load

SCALES = np.array([0.1] * 2 + [1.0] * 2 + [2.0] * 15)


def taught(model, seed=0, steps=80, every=1):
    """Teach a lap of random inputs in which help is a - u = (-.1, -.35) plus something smooth."""
    rng = np.random.default_rng(seed)
    model.start_lap()
    rows = []
    for step in range(steps):
        x = np.concatenate([rng.uniform(-0.5, 0.7, 4), rng.uniform(0.3, 4.0, 15)])
        helping = step % every == 0
        command = Command(x[0] - 0.1, x[1] - 0.35 + 0.05 * np.tanh(x[9] - 2.0))
        answer = model.assist(x)
        model.learn(helping=helping, command=command if helping else None)
        rows.append((x, command, helping, answer))
    return rows


def window_after(rows, last):
    """Windows as the model saw them, newest first, in lengthscales."""
    x = [np.zeros(19)] * 3 + [row[0] for row in rows]
    return np.array(x[last : last + 4][::-1]) / SCALES


def test_it_is_a_batch_gaussian_process_on_a_minus_u():
    """Mean u + mu and the variance are those of an exact GP with k + sigma_c^2, to 1e-10."""
    model = CorrectionAssistant(LADParameters(novelty=1e-9))
    rows = taught(model, every=2)
    windows = np.array([window_after(rows, t) for t in range(len(rows))])
    helped = [t for t, row in enumerate(rows) if row[2]]
    b = windows[helped]
    K = np.array([recursive_kernel(b, w, 1.21, 0.1, 0.1) for w in b])
    factor = cho_factor(K + 0.01 * np.eye(len(b)))
    y = np.array([np.subtract(rows[t][1], rows[t][0][:2]) for t in helped])
    x = np.full(19, 1.5)
    answer = model.assist(x)
    now = np.vstack([x, *(row[0] for row in rows[:-4:-1])]) / SCALES
    k = recursive_kernel(b, now, 1.21, 0.1, 0.1)
    assert np.abs(np.array(answer.mean) - (x[:2] + k @ cho_solve(factor, y))).max() < 1e-10
    assert abs(answer.variance - (0.2 - k @ cho_solve(factor, k) + 0.01)) < 1e-10


def test_where_nothing_was_demonstrated_it_does_as_the_user_does():
    """Before a demonstration the command is the user's; far from one, the mean correction is."""
    model = CorrectionAssistant()
    model.start_lap()
    x = np.concatenate([[0.4, -0.15, 0.3, -0.1], np.full(15, 2.0)])
    assert np.allclose(model.assist(x).mean, x[:2], atol=1e-15)
    assert model.assist(x).variance == pytest.approx(0.1 + 0.1 + 0.01)
    taught(model)
    model.start_lap()
    far = np.concatenate([[0.1, 0.4, -3.0, 3.0], np.full(15, 40.0)])
    mean = model.assist(far).mean
    assert mean.v - far[0] == pytest.approx(-0.1, abs=0.02)
    assert mean.w - far[1] == pytest.approx(-0.35, abs=0.05)


def test_when_is_learnt_as_by_the_papers_model():
    """p(h) is that of Table I to the last bit: only the target of the regressor differs."""
    paper, correction = LADAssistant(), CorrectionAssistant()
    for one, other in zip(taught(paper, every=3), taught(correction, every=3), strict=True):
        assert one[3].p_help == other[3].p_help


def test_without_the_constant_the_machinery_is_the_papers():
    """With sigma_c^2 = 0 the regressor is the process that the conformance vectors are about."""
    rng = np.random.default_rng(0)
    x, y = rng.normal(size=(60, 19)), rng.normal(size=(60, 2))
    plain = LADParameters().regressor
    zero = CorrectionAssistant(LADParameters(constant_variance=0.0)).parameters.regressor
    assert zero == plain
    one, other = StorkGP(plain, n_outputs=2), StorkGP(zero, n_outputs=2)
    learn_stream(one, x, y)
    learn_stream(other, x, y)
    assert one.to_bytes() == other.to_bytes()


def test_saved_between_looking_and_learning_it_goes_on_bit_for_bit(tmp_path):
    """The user's command is in the window: nothing else has to be kept."""
    model = CorrectionAssistant()
    taught(model)
    model.assist(np.full(19, 0.3))
    model.save(tmp_path / "model.npz")
    loaded = load(str(tmp_path / "model.npz"))
    unpickled = pickle.loads(pickle.dumps(model))  # noqa: S301  # our own bytes
    assert type(loaded) is type(unpickled) is CorrectionAssistant
    for one in (model, loaded, unpickled):
        one.learn(helping=True, command=Command(0.2, -0.4))
    assert loaded.to_bytes() == unpickled.to_bytes() == model.to_bytes()


def test_a_file_of_one_kind_is_not_the_other(tmp_path):
    """Each class refuses the other's file; the general loader takes both."""
    model = CorrectionAssistant()
    with pytest.raises(ModelFileError, match="holds a 'lad-correction'; wanted is a 'lad-assi"):
        LADAssistant.from_bytes(model.to_bytes())
    with pytest.raises(ModelFileError, match="holds a 'lad-assistant'; wanted is a 'lad-corr"):
        CorrectionAssistant.from_bytes(LADAssistant().to_bytes())
    LADAssistant().save(tmp_path / "paper.npz")
    assert type(load(str(tmp_path / "paper.npz"))) is LADAssistant


@pytest.mark.parametrize("missing", [slice(0, 2), slice(1, 2)])
@pytest.mark.parametrize("how", ["left out", "no number"])
def test_without_the_users_command_nothing_is_learnt(missing, how):
    """A correction is of something: inputs without it are refused, and the model is what it was."""
    model = CorrectionAssistant()
    taught(model, steps=5)
    before = model.to_bytes()
    x = np.full(19, 0.3)
    x[missing] = np.nan
    with pytest.raises(InvalidInputError):
        model.assist(x if how == "no number" else np.delete(x, missing))
    assert model.to_bytes() == before
    model.start_lap()
    with pytest.raises(InvalidTargetError, match="nothing was seen"):
        model.learn(helping=True, command=Command(0.2, -0.3))
    assert model.how.n_basis == CorrectionAssistant.from_bytes(before).how.n_basis


@pytest.mark.parametrize("bad", [Command(np.nan, 0.0), (0.1,), (0.1, 0.2, 0.3), None])
def test_a_bad_command_changes_nothing(bad):
    """The errors of the paper's model, and the same bytes as before."""
    model = CorrectionAssistant()
    taught(model, steps=5)
    model.assist(np.full(19, 0.3))
    before = model.to_bytes()
    with pytest.raises(InvalidTargetError):
        model.learn(helping=True, command=bad)
    assert model.to_bytes() == before


def test_the_watch_keeps_q_an_inverse_over_a_smooth_stream():
    """The constant is in the watch's kernel matrix: |QK - I| stays under 1e-6 when it repairs."""
    model = CorrectionAssistant(LADParameters(capacity=60))
    model.start_lap()
    for step in range(900):
        x = np.sin(0.02 * step + np.arange(19.0))
        x[4:] += 2.0
        model.assist(x)
        model.learn(helping=True, command=Command(0.3, -0.4))
    assert model.how.residual() < 1e-5
    assert model.how.health.recoveries == 0


def test_prior_help_is_what_an_untrained_model_says():
    """Pi where nothing is known, for both models; the learnt answer approaches what was shown."""
    for make in (LADAssistant, CorrectionAssistant):
        model = make(LADParameters(prior_help=0.35))
        model.start_lap()
        assert model.assist(np.zeros(19)).p_help == pytest.approx(0.35, abs=1e-12)
        for _ in range(30):
            model.assist(np.zeros(19))
            model.learn(helping=True, command=Command(0.1, 0.1))
        assert model.assist(np.zeros(19)).p_help > 0.9
