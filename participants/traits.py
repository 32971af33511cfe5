"""What makes one person drive and answer differently from another.

Each trait's unit is part of its name (``per_s``: 1/s; no suffix: no unit), its range and source
are here; how traits are distributed over people is in ``participants.population``.
"""

from dataclasses import dataclass, fields
from typing import Annotated, get_args, get_type_hints

from protocols.files.errors import InputError


@dataclass(frozen=True, slots=True)
class Trait:
    """A trait's allowed range, both ends included, and where it comes from."""

    low: float
    high: float
    source: str


class _Ranged:
    """A dataclass of traits that checks each against its own range."""

    __slots__ = ()

    def __post_init__(self) -> None:
        for name, trait in declared(type(self)).items():
            value = getattr(self, name)
            if not trait.low <= value <= trait.high:
                raise InputError(
                    f"trait {name}: {value} is out of range; allowed: {trait.low:g} to "
                    f"{trait.high:g}"
                )


@dataclass(frozen=True, slots=True)
class Traits(_Ranged):
    """How one person drives.

    Attributes
    ----------
    preferred_speed_m_s
        Speed on a free straight once practised.
    lookahead_s
        How far ahead the person aims, in seconds of travel.
    reaction_delay_s
        From seeing to the hand's beginning to move.
    stick_lag_s
        Time constant with which hand and stick follow the intention.
    steering_gain_per_s
        Turn rate asked for per radian of direction error.
    motor_noise
        Standard deviation of the stick's deflection as a share of the deflection.
    corner_speed_m_s
        Speed kept in a sharp corner; below the stick's dead band the person stops to turn.
    corner_deflection
        Share of full deflection used to turn in a sharp corner once practised.
    corner_pause_s
        Hesitation at a sharp corner per unit of the corners' inexperience.
    clearance_m
        Distance from obstacles below which the person slows down.
    lane_offset_m
        Habitual distance from the middle of the way, left positive.
    inexperience
        Slowness at the very first lap: 1 doubles the time a movement takes.
    corner_share
        Share of the inexperience that shows in sharp corners rather than on the way.
    practice_exponent
        Inexperience in the n-th lap is that of the first times n to minus this power.
    compliance
        Share of the deflection given up while the assistant drives.
    adaptation_per_s
        How fast the person notices that the chair turns less than asked.
    limit_push
        How far the person then compensates: 0 not at all, 1 until the stick's end.
    limit_pause_s
        How long the person stops the first time the chair turns a third as fast as asked.
    patience_s
        Time in one lap after which the person may give up.

    Raises
    ------
    InputError
        When a trait is outside its range.
    """

    preferred_speed_m_s: Annotated[
        float, Trait(0.15, 0.7, "top speed of the chair: Soh & Demiris (2013), section IV.A")
    ]
    lookahead_s: Annotated[
        float, Trait(0.5, 5.0, "preview of 1 to 3 s: Salvucci & Gray (2004), Perception 33")
    ]
    reaction_delay_s: Annotated[
        float, Trait(0.1, 1.0, "manual tracking, 0.15 to 0.4 s: McRuer & Jex (1967), IEEE THFE 8")
    ]
    stick_lag_s: Annotated[
        float, Trait(0.02, 0.6, "neuromuscular lag, 0.1 to 0.2 s: McRuer & Jex (1967)")
    ]
    steering_gain_per_s: Annotated[
        float, Trait(0.3, 4.0, "crossover of 1 to 4 rad/s in tracking: McRuer & Jex (1967)")
    ]
    motor_noise: Annotated[
        float, Trait(0.0, 0.5, "noise grows with the signal: Harris & Wolpert (1998), Nature 394")
    ]
    corner_speed_m_s: Annotated[float, Trait(0.0, 0.5, "assumption: from stopping to swinging")]
    corner_deflection: Annotated[float, Trait(0.2, 1.0, "assumption: most push to the end")]
    corner_pause_s: Annotated[float, Trait(0.0, 5.0, "assumption: hesitation to look around")]
    clearance_m: Annotated[
        float, Trait(0.02, 0.6, "assumption: personal margin to obstacles, decimetres")
    ]
    lane_offset_m: Annotated[float, Trait(-0.3, 0.3, "assumption: habits of centimetres")]
    inexperience: Annotated[
        float, Trait(0.0, 10.0, "spread of first laps: Soh & Demiris (2013), section V.B")
    ]
    corner_share: Annotated[
        float, Trait(0.0, 1.0, "novices lose time in tight places: Sorrento et al. (2011), JNER 8")
    ]
    practice_exponent: Annotated[
        float, Trait(0.0, 1.5, "power law of practice: Newell & Rosenbloom (1981)")
    ]
    compliance: Annotated[float, Trait(0.0, 1.0, "assumption: from pushing on to letting go")]
    adaptation_per_s: Annotated[
        float, Trait(0.05, 5.0, "gain adaptation within seconds: McRuer & Jex (1967)")
    ]
    limit_push: Annotated[
        float, Trait(0.0, 1.0, "gain taken over by the person: McRuer & Jex (1967)")
    ]
    limit_pause_s: Annotated[
        float, Trait(0.0, 60.0, "finding out about a changed plant: Young (1969), Ergonomics 12")
    ]
    patience_s: Annotated[
        float, Trait(10.0, 3600.0, "assumption: none of twelve left, Soh & Demiris (2013)")
    ]


@dataclass(frozen=True, slots=True)
class ResponseStyle(_Ranged):
    """How one person answers a questionnaire, whatever it asks.

    Attributes
    ----------
    acquiescence
        Shift towards agreement with any item, in units of the latent answer's noise.
    extremity
        Stretch of the latent answer: above 1 the scale's ends are used more.
    liking
        Shift towards assistance of any kind, in units of the latent answer's noise.
    missing_share
        Probability of leaving an item out.

    Raises
    ------
    InputError
        When one of them is outside its range.
    """

    acquiescence: Annotated[float, Trait(-3.0, 3.0, "Baumgartner & Steenkamp (2001), JMR 38")]
    extremity: Annotated[float, Trait(0.2, 5.0, "Greenleaf (1992), Public Opinion Quarterly 56")]
    liking: Annotated[float, Trait(-3.0, 3.0, "assumption: general attitude to assistance")]
    missing_share: Annotated[
        float, Trait(0.0, 0.5, "one of twelve left a survey unfinished: Soh & Demiris (2013)")
    ]


def declared(kind: type) -> dict[str, Trait]:
    """Return the range and source of each trait of a dataclass, by name and in its order.

    Parameters
    ----------
    kind
        A dataclass whose fields are annotated with a ``Trait``.

    Examples
    --------
    >>> declared(ResponseStyle)["missing_share"].high
    0.5
    """
    hints = get_type_hints(kind, include_extras=True)
    return {field.name: get_args(hints[field.name])[1] for field in fields(kind)}
