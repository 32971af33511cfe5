"""How practised a person is in a lap."""

from dataclasses import dataclass

from participants.traits import Traits


@dataclass(frozen=True, slots=True)
class Skill:
    """How inexperience changes a lap.

    Attributes
    ----------
    way
        Share of the preferred speed that is driven on the way, in (0, 1].
    corner
        Share of the practised speed and deflection in sharp corners, in (0, 1].
    pause
        Hesitation at each sharp corner, s.
    """

    way: float
    corner: float
    pause: float


def skill(traits: Traits, lap: int) -> Skill:
    """Return a person's skill in a lap.

    The time a movement takes follows the power law of practice (Newell & Rosenbloom, 1981, in
    Anderson: Cognitive Skills and Their Acquisition): its excess over the practised time in the
    n-th lap is that of the first one times n to minus the practice exponent.

    Parameters
    ----------
    traits
        The person.
    lap
        Position of the lap in the session, counted from 0.

    Examples
    --------
    >>> from participants.cohort import typical_traits
    >>> traits = typical_traits()
    >>> skill(traits, 0).way < skill(traits, 3).way < 1
    True
    """
    excess = traits.inexperience * (lap + 1) ** -traits.practice_exponent
    at_corners = excess * traits.corner_share
    return Skill(
        way=1.0 / (1.0 + excess * (1.0 - traits.corner_share)),
        corner=1.0 / (1.0 + at_corners),
        pause=traits.corner_pause_s * at_corners,
    )
