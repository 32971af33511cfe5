"""A demonstrator who corrects: only where needed, and then to the end of the takeover."""

from harness.session.intervention import Intervention
from lad.assistant import Assistance
from lad.command import Command
from protocols.condition import Corrections

USER = Command(0.3, -0.15)
TURNS = Assistance(helping=True, command=Command(0.25, -0.5))
ALIKE = Assistance(helping=True, command=Command(0.25, -0.45))
NOTHING = Assistance(helping=False)


def over(answers, **settings):
    """Return in which of the steps, 0.1 s apart, the demonstrator has control."""
    one = Intervention(Corrections(**settings))
    return [one.needed(d, m, USER, 0.1 * i) for i, (d, m) in enumerate(answers)]


def test_a_model_that_does_alike_is_left_alone():
    """As long as the command that counts is within the tolerance, nobody takes over."""
    assert not any(over([(TURNS, ALIKE)] * 20))


def test_it_waits_for_its_patience_and_then_stays_until_it_is_done():
    """0.3 s without the help it would give; then control, though the model helps again."""
    steps = [(TURNS, NOTHING)] * 4 + [(TURNS, ALIKE)] * 3 + [(NOTHING, ALIKE)] * 2
    assert over(steps, patience_s=0.3) == [False] * 3 + [True] * 4 + [False] * 2


def test_a_short_difference_is_forgotten():
    """Patience counts from the last step in which all was well."""
    steps = [(TURNS, NOTHING)] * 2 + [(TURNS, ALIKE)] + [(TURNS, NOTHING)] * 2
    assert not any(over(steps, patience_s=0.3))


def test_where_it_would_not_help_it_never_takes_over():
    """A model that helps too much is not corrected by a demonstrator who only helps."""
    assert not any(over([(NOTHING, TURNS)] * 20, patience_s=0.0, tolerance=0.0))


def test_the_users_own_command_may_do():
    """Without the model's help the command that counts is the user's: it is compared, too."""
    close = Assistance(helping=True, command=Command(0.31, -0.16))
    assert not any(over([(close, NOTHING)] * 9, patience_s=0.0))
