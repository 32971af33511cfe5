"""The level of assistance: what share of the command the demonstrations speak for."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lad.command import Command
from lad.correction import CorrectionAssistant
from lad.errors import HyperparameterError, InvalidTargetError, ModelFileError
from lad.hyperparameters import LADParameters
from lad.level import LEAST_DIFFERENCE, LevelAssistant, share_of
from lad.trained import load

NUMBER = st.floats(-1, 1)
COMMANDS = st.builds(Command, NUMBER, NUMBER)


def x_at(place):
    """Return inputs of a place: a user who drives straight on, and a wall that comes nearer."""
    x = np.full(19, 4.0)
    x[:4] = 0.3, -0.15, 0.3, -0.1
    x[4:] -= 3.0 * place
    return x


def taught(model, laps=1):
    """Teach help in the second half of each lap."""
    for _ in range(laps):
        model.start_lap()
        for step in range(60):
            model.assist(x_at(step / 60))
            helping = step >= 30
            model.learn(helping=helping, command=Command(0.2, -0.5) if helping else None)
    return model


@given(COMMANDS, COMMANDS)
def test_the_share_is_the_best_of_all_shares(given_one, predicted):
    """No share in [0, 1] brings the mixed command nearer to the demonstrator's."""
    best = share_of(given_one, predicted)
    assert 0 <= best <= 1
    if np.hypot(*predicted) < LEAST_DIFFERENCE:
        assert best == 1
        return
    grid = np.append(np.linspace(0, 1, 201), best)
    distance = np.hypot(given_one.v - grid * predicted.v, given_one.w - grid * predicted.w)
    assert distance[-1] <= distance.min() + 1e-12


def test_when_and_how_are_those_of_the_correction_model():
    """The third process changes nothing in the two others."""
    level, plain = taught(LevelAssistant(), laps=2), taught(CorrectionAssistant(), laps=2)
    for place in (0.1, 0.5, 0.9):
        one, other = level.assist(x_at(place)), plain.assist(x_at(place))
        assert one._replace(share=None) == other


def test_the_level_follows_the_demonstrations():
    """Nothing where nothing is known or nobody helped; nearly all where help was given."""
    model = taught(LevelAssistant(), laps=2)
    model.start_lap()
    shares = [model.assist(x_at(step / 60)).share for step in range(60)]
    assert max(shares[:25]) < 0.1
    assert min(shares[40:]) > 0.8
    far = np.full(19, 0.2)
    far[:4] = -0.5, 0.5, -0.5, 0.5
    model.start_lap()
    assert model.assist(far).share < 0.05


def test_who_is_contradicted_earns_less():
    """What it predicted before it learnt a step is held against what the demonstrator did."""
    model = taught(LevelAssistant(), laps=3)
    before = [model.assist(x_at(0.9)).share for _ in range(4)][-1]
    for turn in (0.5, -0.5) * 10:
        model.assist(x_at(0.9))
        model.learn(helping=True, command=Command(0.3, turn))
    assert model.assist(x_at(0.9)).share < before - 0.2


def test_saved_between_looking_and_learning_it_goes_on_bit_for_bit(tmp_path):
    """Three processes, two windows."""
    model = taught(LevelAssistant())
    model.start_lap()
    for place in (0.6, 0.7, 0.8):
        model.assist(x_at(place))
    model.save(tmp_path / "model.npz")
    loaded = load(str(tmp_path / "model.npz"))
    assert type(loaded) is LevelAssistant
    for one in (model, loaded):
        one.learn(helping=True, command=Command(0.2, -0.4))
    assert loaded.to_bytes() == model.to_bytes()
    with pytest.raises(ModelFileError, match="holds a 'lad-level'"):
        CorrectionAssistant.from_bytes(model.to_bytes())


def test_tuning_leaves_the_level_as_it_is():
    """It is no part of the evidence."""
    model = taught(LevelAssistant(LADParameters(tune="evidence")))
    plain = taught(LevelAssistant())
    model.start_lap()
    plain.start_lap()
    assert model.tuned is not None
    assert model.assist(x_at(0.9)).share == plain.assist(x_at(0.9)).share
    assert LevelAssistant.from_bytes(model.to_bytes()).to_bytes() == model.to_bytes()


@pytest.mark.parametrize("bad", [Command(np.nan, 0.0), None])
def test_a_bad_command_changes_nothing(bad):
    """As with the other models."""
    model = taught(LevelAssistant())
    before = model.to_bytes()
    with pytest.raises(InvalidTargetError):
        model.learn(helping=True, command=bad)
    assert model.to_bytes() == before
    model.start_lap()
    with pytest.raises(InvalidTargetError, match="nothing was seen"):
        model.learn(helping=True, command=Command(0.1, 0.1))


def test_it_does_not_forget():
    """So that nobody believes it does."""
    with pytest.raises(HyperparameterError, match="memory_laps"):
        LevelAssistant(LADParameters(memory_laps=2))
