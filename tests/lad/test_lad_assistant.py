"""When and how together, as a study uses them."""

import pickle

import numpy as np
import pytest

from lad.assistant import Learner
from lad.command import Command
from lad.errors import InvalidInputError, InvalidTargetError, ModelFileError
from lad.hyperparameters import LADParameters
from lad.lad_assistant import LADAssistant
from lad.snapshot import state_arrays
from lad.stork_gp import StorkGP

HELP = Command(0.3, -0.5)


def inputs(right_turn):
    """Make the inputs of a straight, or of a sharp right turn with a wall ahead."""
    x = np.full(19, 2.0)
    x[:4] = (0.4, -0.15, 0.4, -0.15) if right_turn else (0.7, 0.0, 0.7, 0.0)
    x[9:14] = 0.8 if right_turn else 3.5
    return x


def lap(rng, steps=60):
    """Make one lap: (inputs, whether the demonstrator helps), with lidar noise."""
    for step in range(steps):
        turning = step % 30 >= 20
        x = inputs(turning)
        x[4:] += 0.02 * rng.standard_normal(15)
        yield x, turning


def trained(parameters=None):
    """Train on one lap."""
    model = LADAssistant(parameters)
    model.start_lap()
    for x, turning in lap(np.random.default_rng(0)):
        model.assist(x)
        model.learn(helping=turning, command=HELP if turning else None)
    return model


def test_untrained_never_helps_though_it_says_one_half():
    """One half reaches the threshold, but a regressor without basis vectors never assists."""
    model = LADAssistant()
    model.start_lap()
    answer = model.assist(inputs(right_turn=True))
    assert answer.helping is False
    assert answer.command is None
    assert answer.p_help == 0.5
    assert answer.mean == Command(0.0, 0.0)
    assert answer.variance == pytest.approx(0.11)


def test_a_model_that_saw_no_help_never_helps():
    """A classifier alone, however sure, has no command to give."""
    model = LADAssistant(LADParameters(threshold=0.0))
    model.start_lap()
    for x, _ in lap(np.random.default_rng(0)):
        model.assist(x)
        model.learn(helping=False, command=None)
    assert model.how.n_basis == 0
    assert model.assist(inputs(right_turn=True)).helping is False


def test_one_demonstration_teaches_when_and_how():
    """After a single lap it helps at the turns and not elsewhere, with the demonstrated command."""
    model = trained()
    model.start_lap()
    wrong, offs = [], []
    for x, turning in lap(np.random.default_rng(1)):
        answer = model.assist(x)
        wrong.append(answer.helping != turning)
        assert (answer.command is None) == (not answer.helping)
        if answer.helping:
            assert answer.command == answer.mean
            offs.append(abs(answer.command.w - HELP.w))
    assert np.mean(wrong) < 0.1
    assert np.mean(offs) < 0.1


def test_the_regressor_learns_only_where_help_was_given():
    """The classifier sees every step, the regressor those with h = +1, in the same window."""
    model = LADAssistant()
    model.start_lap()
    helped = []
    for t, (x, turning) in enumerate(lap(np.random.default_rng(0))):
        model.assist(x)
        model.learn(helping=turning, command=HELP if turning else None)
        if turning:
            helped.append(t)
    assert set(model.how.times.tolist()) <= set(helped)
    assert model.how.window is model.when.window
    assert model.when.window.time == 59


def test_looking_is_not_learning():
    """Laps that are only watched change the window and nothing that was learnt."""
    model = trained()
    before = state_arrays(model.when.state) | {"how": model.how.state.alpha.copy()}
    model.start_lap()
    for x, _ in lap(np.random.default_rng(2)):
        model.assist(x)
    after = state_arrays(model.when.state) | {"how": model.how.state.alpha}
    assert all(np.array_equal(before[name], after[name]) for name in before)


def test_threshold_and_probability_are_parameters():
    """W_h = 1 silences the model; the paper's literal form is sharper where the latent is sure."""
    sure, paper = trained(), trained(LADParameters(probability="paper"))
    silent = trained(LADParameters(threshold=1.0))
    for model in (sure, paper, silent):
        model.start_lap()
    x = inputs(right_turn=True)
    one, other = sure.assist(x), paper.assist(x)
    assert 0.5 < one.p_help < other.p_help
    assert silent.assist(x).helping is False


def test_what_cannot_be_learnt_is_refused_and_changes_nothing():
    """Help without a command, a wrong command, nothing seen: named errors, the same bytes."""
    model = LADAssistant()
    model.start_lap()
    with pytest.raises(InvalidTargetError, match="nothing was seen"):
        model.learn(helping=False, command=None)
    model.assist(inputs(right_turn=True))
    before = model.to_bytes()
    with pytest.raises(InvalidTargetError, match="command: given None while helping"):
        model.learn(helping=True, command=None)
    with pytest.raises(InvalidTargetError, match="given nan"):
        model.learn(helping=True, command=Command(np.nan, 0.0))
    with pytest.raises(InvalidInputError, match="given shape"):
        model.assist(np.zeros(18))
    with pytest.raises(InvalidInputError, match="given nan at index 4"):
        model.assist(np.r_[np.zeros(4), np.nan, np.zeros(14)])
    assert model.to_bytes() == before


def test_a_new_lap_forgets_the_past_only():
    """The same input right after the start gets the same answer in every lap."""
    model = trained()
    answers = []
    for _ in range(2):
        model.start_lap()
        answers.append(model.assist(inputs(right_turn=True)))
        model.assist(inputs(right_turn=False))
    assert answers[0] == answers[1]


def test_saved_pair_is_bit_identical(tmp_path):
    """One file holds both; it loads, pickles and continues to learn bit for bit."""
    model = trained()
    model.save(tmp_path / "model.npz")
    loaded = LADAssistant.load(tmp_path / "model.npz")
    unpickled = pickle.loads(pickle.dumps(model))  # noqa: S301  # our own bytes
    assert loaded.to_bytes() == unpickled.to_bytes() == model.to_bytes()
    for one in (model, loaded, unpickled):
        for x, turning in lap(np.random.default_rng(3)):
            one.assist(x)
            one.learn(helping=turning, command=HELP if turning else None)
    assert loaded.to_bytes() == unpickled.to_bytes() == model.to_bytes()


def test_a_single_process_is_not_a_pair():
    """A file of another kind says what it holds."""
    with pytest.raises(ModelFileError, match="holds a 'stork-gp'; wanted is a 'lad-assistant'"):
        LADAssistant.from_bytes(StorkGP(LADParameters().regressor).to_bytes())


def test_it_fits_the_seam():
    """A study recognises it as an assistant that learns."""
    assert isinstance(LADAssistant(), Learner)
