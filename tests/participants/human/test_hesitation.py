"""A chair that does not obey makes people stop and wonder; less each time."""

import pytest

from participants.human.corners import Corner
from participants.human.hesitation import BELIEVED, FULL, Hesitation
from participants.human.turn_response import TurnResponse

FIRST, SECOND = Corner(1.0, 2.0, -2.0), Corner(5.0, 6.0, -2.0)
LEFT = Corner(8.0, 9.0, 2.0)


def hesitation(believed, pause=10.0, exponent=0.5):
    """Return the hesitation of a person who believes that the chair obeys so far to the right."""
    response = TurnResponse(1.0)
    response.right = believed
    return Hesitation(pause, exponent, response)


@pytest.mark.parametrize("believed", [BELIEVED, 0.9, 1.0])
def test_a_chair_that_obeys_makes_nobody_wonder(believed):
    """A little less than asked is what any chair does."""
    assert hesitation(believed).due(FIRST) == 0.0


def test_the_limited_chair_is_wondered_at_for_the_whole_pause():
    """At the paper's limitation the first corner costs the trait's seconds; half way, half."""
    assert hesitation(FULL).due(FIRST) == pytest.approx(10.0)
    assert hesitation(0.0).due(FIRST) == pytest.approx(10.0)
    assert hesitation((FULL + BELIEVED) / 2).due(FIRST) == pytest.approx(5.0)


def test_only_the_side_that_disobeys_counts():
    """A left turn is as it always was."""
    assert hesitation(FULL).due(LEFT) == 0.0


def test_each_corner_takes_less_than_the_one_before():
    """The power law of practice in corners at which the chair did not obey, over laps."""
    person = hesitation(FULL)
    seconds = [person.due(FIRST), person.due(FIRST), person.due(SECOND)]
    person.start_lap()
    seconds.append(person.due(FIRST))
    assert seconds == pytest.approx([10.0, 10.0, 10.0 * 2**-0.5, 10.0 * 3**-0.5])
