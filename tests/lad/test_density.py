"""Equation (1) is a density: it has mass one and peaks where it should."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lad.assistant import NO_ASSISTANCE, Assistance
from lad.command import Command
from lad.density import log_density
from lad.errors import InvalidTargetError


def answer(p, v=0.3, w=-0.4, variance=0.02):
    """Make a model's answer."""
    return Assistance(p >= 0.5, Command(v, w), p, Command(v, w), variance)


@given(st.floats(0.01, 0.99), st.floats(0.005, 0.1))
def test_mass_is_one(p, variance):
    """The mass at no help and the integral over all commands add up to 1."""
    prediction = answer(p, variance=variance)
    sd = math.sqrt(variance)
    offsets, width = np.linspace(-8.0 * sd, 8.0 * sd, 81, retstep=True)
    density = [
        math.exp(log_density(prediction, Command(0.3 + a, -0.4 + b)))
        for a in offsets
        for b in offsets
    ]
    assert math.exp(log_density(prediction, None)) == pytest.approx(1.0 - p)
    assert sum(density) * width**2 == pytest.approx(p, rel=1e-6)


@given(st.floats(0.0, 1.0), st.floats(-1.0, 1.0), st.floats(-1.0, 1.0))
def test_largest_at_the_mean(p, v, w):
    """No command is likelier than the predicted one."""
    prediction = answer(p)
    assert log_density(prediction, Command(v, w)) <= log_density(prediction, Command(0.3, -0.4))


def test_certainty_is_punished_without_limit():
    """What the model excluded has log density minus infinity."""
    assert log_density(answer(1.0), None) == -math.inf
    assert log_density(answer(0.0), Command(0.3, -0.4)) == -math.inf
    assert log_density(answer(0.0), None) == 0.0


def test_an_answer_without_probabilities_is_refused():
    """A demonstrator's answer has no density."""
    with pytest.raises(InvalidTargetError, match="without p_help"):
        log_density(NO_ASSISTANCE, None)
