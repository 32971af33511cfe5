"""Gates are passed in their order and direction."""

import math

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from protocols.course.gates import GateCounter, crossing, forward
from protocols.course.schema import Gate
from protocols.pose import Pose

FINISH = Gate(name="F", left=(0.0, 1.0), right=(0.0, -1.0))
metres = st.floats(-5, 5).map(lambda x: round(x, 3))


@given(metres, metres, metres, metres)
def test_a_gate_is_passed_forwards_between_its_posts(ax, ay, bx, by):
    """A move passes the gate x = 0, |y| < 1 just when it goes from x < 0 to x >= 0 in between."""
    share = crossing(FINISH, (ax, ay), (bx, by))
    if ax < 0 <= bx:
        expected = -ax / (bx - ax)
        y = ay + expected * (by - ay)
        assume(abs(abs(y) - 1) > 1e-9)
        assert (share is not None) == (abs(y) < 1)
        assert share is None or share == pytest.approx(expected)
    else:
        assert share is None


@given(st.tuples(metres, metres, metres, metres), st.floats(-3, 3), metres, metres)
def test_gates_do_not_care_where_the_origin_is(move, turn, dx, dy):
    """Turned and shifted together, gate and move meet as before."""
    ax, ay, bx, by = move
    assume(min(abs(ax), abs(bx)) > 1e-6)

    def moved(x, y):
        return (
            dx + x * math.cos(turn) - y * math.sin(turn),
            dy + x * math.sin(turn) + y * math.cos(turn),
        )

    here = crossing(FINISH, (ax, ay), (bx, by))
    if ax < 0 < bx:
        y = ay - ax / (bx - ax) * (by - ay)
        assume(abs(abs(y) - 1) > 1e-6)
    gate = Gate(name="F", left=moved(0, 1), right=moved(0, -1))
    there = crossing(gate, moved(ax, ay), moved(bx, by))
    assert (here is None) == (there is None)
    assert here is None or there == pytest.approx(here, abs=1e-6)


def test_forward_has_the_left_post_on_the_left():
    """The direction through a gate is a unit vector, a right angle clockwise from right to left."""
    assert forward(FINISH) == (1.0, 0.0)
    assert forward(Gate(name="G", left=(2.0, 0.0), right=(5.0, 4.0))) == pytest.approx((-0.8, 0.6))


def test_a_gate_touched_at_a_steps_end_is_passed_once(ring_course):
    """A move that ends on the line passes it; the next move, from the line on, does not again."""
    counter = GateCounter(ring_course)
    assert counter.advance((3.5, 0.0), (4.0, 0.0)) == 1.0
    assert counter.advance((4.0, 0.0), (4.5, 0.0)) is None
    assert counter.passed == 1


def test_gates_count_only_in_their_order(ring_course):
    """R2 and F before R1 do not count; backwards through R1 does not either."""
    counter = GateCounter(ring_course)
    assert counter.advance((2.5, -3.0), (1.5, -3.0)) is None
    assert counter.advance((0.0, 0.0), (1.0, 0.0)) is None
    assert counter.advance((4.5, 0.0), (3.5, 0.0)) is None
    assert counter.advance(Pose(3.5, 0.0, 1.0), Pose(4.5, 0.0, 1.0)) == pytest.approx(0.5)
    assert counter.advance((2.5, -3.0), (1.5, -3.0)) == pytest.approx(0.5)
    assert not counter.finished
    assert counter.advance((0.0, 0.0), (1.0, 0.0)) == pytest.approx(0.5)
    assert counter.finished
    assert counter.advance((0.0, 0.0), (1.0, 0.0)) is None
    assert counter.passed == 3
