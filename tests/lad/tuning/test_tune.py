"""Tuning as a study uses it: at lap start, saved, refused with too little, forgetting."""

import pickle

import numpy as np
import pytest

from lad.command import Command
from lad.correction import CorrectionAssistant
from lad.errors import HyperparameterError, ModelFileError, TooFewStepsError
from lad.hyperparameters import LADParameters
from lad.lad_assistant import LADAssistant
from lad.tuning.tune import NOVELTY, tune

BOTH = pytest.mark.parametrize("make", [LADAssistant, CorrectionAssistant])


def lap(model, seed, steps=120, learn=True):
    """Drive one lap: in the second half of every 40 steps the demonstrator turns right."""
    rng = np.random.default_rng(seed)
    model.start_lap()
    answers = []
    for step in range(steps):
        turning = step % 40 >= 20
        x = np.full(19, 2.0)
        x[:4] = (0.4, -0.15, 0.4, -0.3) if turning else (0.7, 0.0, 0.7, 0.0)
        x[:2] += 0.02 * rng.standard_normal(2)
        x[4:] += 0.05 * rng.standard_normal(15)
        answers.append((model.assist(x), turning))
        if learn:
            command = Command(x[0] - 0.1, -0.5 + 0.02 * rng.standard_normal())
            model.learn(helping=turning, command=command if turning else None)
    return answers


@BOTH
def test_tuned_predictions_are_more_likely(make):
    """In a lap not learnt from, the density of the demonstrated commands is higher than untuned."""
    plain, tuned = make(), make(LADParameters(tune="evidence"))
    densities = []
    for model in (plain, tuned):
        lap(model, 0)
        answers = lap(model, 1, learn=False)
        off = [(a.mean.w + 0.5) ** 2 / a.variance + np.log(a.variance) for a, t in answers if t]
        densities.append(-0.5 * np.mean(off))
    assert tuned.tuned is not None
    assert densities[1] > densities[0] + 0.5
    assert tuned.tuned.how.noise_variance < 0.01
    assert tuned.tuned.how.novelty == NOVELTY


def test_the_classifiers_lengthscales_stay():
    """Only the classifier's signal variance is tuned: over lengthscales it becomes a copycat."""
    model = LADAssistant(LADParameters(tune="evidence"))
    lap(model, 0)
    model.start_lap()
    before, after = LADParameters().classifier, model.tuned.when
    assert after.signal_variance != before.signal_variance
    same = {"signal_variance": before.signal_variance}
    assert after.model_copy(update=same) == before


def test_nothing_is_chosen_in_the_lap_that_teaches():
    """The lap that teaches is driven with what stood before; only the next start chooses."""
    tuned, plain = LADAssistant(LADParameters(tune="evidence")), LADAssistant()
    assert [a for a, _ in lap(tuned, 0)] == [a for a, _ in lap(plain, 0)]
    assert tuned.tuned is None
    tuned.start_lap()
    chosen = tuned.tuned
    tuned.start_lap()
    assert tuned.tuned is chosen


@BOTH
def test_too_few_steps_are_refused_and_change_nothing(make):
    """Asked directly it is a named error; at a lap's start everything stays as the study has it."""
    model = make(LADParameters(tune="evidence"))
    lap(model, 0, steps=25)
    before = model.to_bytes()
    with pytest.raises(TooFewStepsError, match="given 5 steps with help and 20 without"):
        model.tune()
    assert model.to_bytes() == before
    model.start_lap()
    assert model.tuned is None
    with pytest.raises(TooFewStepsError, match="given 0 steps"):
        make().tune()


@BOTH
@pytest.mark.slow
def test_a_tuned_model_is_saved_whole(make, tmp_path):
    """Loaded or unpickled, it predicts, learns and tunes on bit for bit."""
    model = make(LADParameters(tune="evidence", prior_help=0.4))
    lap(model, 0)
    lap(model, 1)
    model.save(tmp_path / "model.npz")
    loaded = make.load(tmp_path / "model.npz")
    unpickled = pickle.loads(pickle.dumps(model))  # noqa: S301  # our own bytes
    assert loaded.to_bytes() == unpickled.to_bytes() == model.to_bytes()
    assert loaded.tuned == model.tuned
    for one in (model, loaded, unpickled):
        lap(one, 2)
        one.start_lap()
    assert loaded.to_bytes() == unpickled.to_bytes() == model.to_bytes()


def test_learning_again_is_learning():
    """Teaching what was kept to fresh processes gives the model that was taught directly."""
    kept = LADAssistant(LADParameters(memory_laps=1))
    only_last = LADAssistant(LADParameters(memory_laps=1))
    lap(kept, 0)
    lap(kept, 1)
    lap(only_last, 1)
    one, other = lap(kept, 2, learn=False), lap(only_last, 2, learn=False)
    for (a, _), (b, _) in zip(one, other, strict=True):
        assert a.p_help == pytest.approx(b.p_help, abs=1e-6)
        assert np.allclose(a.mean, b.mean, atol=1e-6)


def test_what_is_older_than_the_memory_is_forgotten():
    """With memory of one lap, a lap without help undoes one with help; without it, less so."""
    shares = []
    for memory in (1, None):
        model = LADAssistant(LADParameters(memory_laps=memory, tune="none"))
        lap(model, 0)
        model.start_lap()
        rng = np.random.default_rng(1)
        for _ in range(60):
            x = np.full(19, 2.0)
            x[:4] = 0.4, -0.15, 0.4, -0.3
            x[4:] += 0.05 * rng.standard_normal(15)
            model.assist(x)
            model.learn(helping=False, command=None)
        shares.append(np.mean([a.p_help for a, turning in lap(model, 2, learn=False) if turning]))
    assert shares[0] < 0.3
    assert shares[0] < shares[1]


def test_a_file_with_half_of_the_steps_is_refused():
    """Arrays that do not fit each other are a named error."""
    model = LADAssistant(LADParameters(tune="evidence"))
    lap(model, 0, steps=30)
    model.taught.targets.pop()
    with pytest.raises((ModelFileError, ValueError)):
        LADAssistant.from_bytes(model.to_bytes())


def test_parameters_are_checked():
    """Another way to tune, or a memory of no laps, is refused in one line."""
    with pytest.raises(HyperparameterError, match="tune"):
        LADParameters(tune="likelihood")
    with pytest.raises(HyperparameterError, match="memory_laps"):
        LADParameters(memory_laps=0)


def test_same_steps_same_choice():
    """Tuning draws nothing at random."""
    models = [CorrectionAssistant(LADParameters(tune="evidence")) for _ in range(2)]
    for model in models:
        lap(model, 0)
    one, other = (tune(model.parameters, model.taught) for model in models)
    assert one == other
