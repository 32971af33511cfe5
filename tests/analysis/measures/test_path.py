"""Path length, deviation and clearance."""

import numpy as np
import pyarrow as pa
import pytest

from analysis.measures.clearance import minimum_clearance
from analysis.measures.driving_time import driving_time
from analysis.measures.path_deviation import path_deviation
from analysis.measures.path_length import path_length
from analysis.measures.streams import Steps


def circle(radius, n=400):
    """Return the columns of once around a circle."""
    angle = np.linspace(0, 2 * np.pi, n)
    return {
        "t_s": np.arange(n) * 0.1,
        "x_m": radius * np.cos(angle),
        "y_m": radius * np.sin(angle),
        "offset_m": np.full(n, -0.25),
        "clearance_m": 1 + np.sin(angle),
    }


def steps_of(columns):
    """Return columns as a lap's steps."""
    return Steps(pa.table(columns))


def test_path_length_of_a_circle_is_its_circumference():
    """A finely sampled circle is as long as 2 pi r."""
    assert path_length(steps_of(circle(2.0))) == pytest.approx(4 * np.pi, rel=1e-4)


def test_path_length_is_unchanged_by_turning_and_shifting(steps):
    """Length does not depend on where the plan's origin lies or which way it looks."""
    turned = steps_of({"x_m": 3 - steps["y_m"], "y_m": steps["x_m"] + 7})
    assert path_length(turned) == pytest.approx(path_length(steps_of(steps)))


def test_constant_offset_is_the_deviation():
    """Driving 0.25 m beside the centreline, on either side, deviates by 0.25 m."""
    assert path_deviation(steps_of(circle(1.0))) == pytest.approx(0.25)


def test_standing_still_does_not_change_the_deviation():
    """Time spent waiting far from the centreline does not count as driving there."""
    waiting = {name: np.append(v, np.full(50, v[-1])) for name, v in circle(1.0).items()}
    waiting["offset_m"][-50:] = 5.0
    assert path_deviation(steps_of(waiting)) == pytest.approx(0.25)


def test_clearance_is_the_smallest_there_was():
    """The closest call counts, missing values do not."""
    columns = circle(1.0)
    columns["clearance_m"][3] = np.nan
    assert minimum_clearance(steps_of(columns)) == pytest.approx(0.0, abs=1e-3)


def test_driving_time_ends_with_the_last_step():
    """Ten steps of 0.1 s take one second."""
    assert driving_time(steps_of(circle(1.0, n=10))) == pytest.approx(1.0)
