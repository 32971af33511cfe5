"""A demonstrator who helps in the sharp right turns and nowhere else.

The lead author's part in the study (section IV.B): control is taken over during the right turns
at R1 and R2. On any course these are the sections labelled ``sharp_right``; asked to watch left
turns, it watches the sections labelled ``left`` that are as sharp.
"""

import math
from collections.abc import Iterator
from typing import Annotated, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from lad.assistant import NO_ASSISTANCE, Assistance
from lad.command import Command
from participants.corner_steering import CornerSteering
from participants.options import Options, read_options
from participants.planning.surroundings import known_raster
from participants.setup import DemonstratorSetup
from participants.sight import Sight
from participants.variability import Drawn, Variability
from protocols.course.centreline import Centreline, Stretch
from protocols.course.schema import Course

EARLIEST = 0.8
"""A turn may begin this far before the corner's section, m."""

LATEST = 1.2
"""No help is given farther past the corner's section than this, m."""

TURNING = -0.1
"""A stick or a chair that turns right faster than this shows that the turn has begun, rad/s."""

STILL_TO_TURN = math.radians(40)
"""Help begins only while the chair must turn right by more than this, rad."""

ALIGNED = math.radians(12)
"""It ends when the chair points along the next leg within this, rad."""

SLOWEST_PACE = 0.2

LEG = 1.0
"""The next leg is looked at this far past the corner, m."""

SHARP = math.radians(60)
"""A section labelled ``left`` that turns by more than this is a sharp one, rad."""


class AttentiveOptions(Options):
    """What a protocol may set for an attentive demonstrator.

    Human variability is off unless asked for, and then changes nothing else: without it not a draw
    is made. Submovements of 2 to 3 a second: Miall, Weir & Stein (1993), J. Motor Behavior 25;
    Loram et al. (2011), J. Physiology 589. Reaction .7 s expected, 1.25 s unexpected: Green (2000),
    Transportation Human Factors 2. Onset scatter, the signal's lag, touches, release and pace:
    assumptions.

    Attributes
    ----------
    reaction_s
        Median time from the beginning of a turn to the takeover, s.
    reaction_spread
        Standard deviation of its logarithm, between interventions.
    pace
        How fast it drives through a corner, as a share of the speed at which the chair, turning
        as fast as it can, could just follow it; by default as ``bench/calibrate_course.py`` found.
    onset_sd_m
        Standard deviation of where it sees a turn begin, along the way, between interventions, m.
    submovements_hz, submovement_noise
        A hand that corrects in steps: so many a second, each off by this standard deviation as a
        share of the command. 0 for a hand that follows continuously.
    h_lag_s
        How long after the hand its takeover signal comes on: it already steers, and the chair does
        not yet obey, s.
    touches_per_lap
        How often, on average, it takes over briefly where no help is needed.
    release_sd
        Standard deviation of where it hands back, as a share of the angle still to turn.
    pace_sd
        Standard deviation of the pace between interventions.
    enough_rad_s
        It abstains once it has seen the limited stick ask for such a turn rate, to either side it
        watches, in this lap or the one before: the user can. None helps always.
    turns
        Which sharp turns it watches: those to the ``right`` (the paper), ``left`` or ``both``.
    """

    reaction_s: Annotated[float, Field(ge=0.0, le=3.0)] = 0.4
    reaction_spread: Annotated[float, Field(ge=0.0, le=1.0)] = 0.25
    pace: Annotated[float, Field(ge=0.2, le=1.0)] = 0.92
    onset_sd_m: Annotated[float, Field(ge=0.0, le=1.0)] = 0.0
    submovements_hz: Annotated[float, Field(ge=0.0, le=10.0)] = 0.0
    submovement_noise: Annotated[float, Field(ge=0.0, le=1.0)] = 0.0
    h_lag_s: Annotated[float, Field(ge=0.0, le=1.0)] = 0.0
    touches_per_lap: Annotated[float, Field(ge=0.0, le=20.0)] = 0.0
    release_sd: Annotated[float, Field(ge=0.0, le=1.0)] = 0.0
    pace_sd: Annotated[float, Field(ge=0.0, le=0.3)] = 0.0
    enough_rad_s: Annotated[float, Field(gt=0.0, le=0.5)] | None = None
    turns: Literal["right", "left", "both"] = "right"


class AttentiveDemonstrator:
    """Takes over at sharp right turns, after a reaction time, and hands back once aligned.

    What it does follows only from what it sees, not from whether its command counts: as a shadow
    it still wants to help until the chair is through the turn, even when the driver turns it.

    Parameters
    ----------
    course
        The course.
    options
        How fast it reacts, and drives.
    rng
        Its random numbers; each lap gets a child of its own.
    """

    def __init__(self, course: Course, options: AttentiveOptions, rng: np.random.Generator) -> None:
        self._line = Centreline(course)
        self._raster = known_raster(course)
        self._options = options
        self._rng = rng
        self._corners = tuple(_watched(self._line, options.turns))
        self._legs = {corner.start: self._line.point(corner.end + LEG) for corner in self._corners}
        self._fastest = (0.0, 0.0)
        self.start_lap()

    def start_lap(self) -> None:
        """Watch a new lap."""
        self._fastest = (
            0.0,
            self._fastest[0],
        )  # turn rates seen in this lap and in the last, rad/s
        (self._lap_rng,) = self._rng.spawn(1)
        self._arc: float | None = None
        self._sight: Sight | None = None
        self._acts_at: float | None = None
        self._steering: CornerSteering | None = None
        # A child of the lap's numbers: drawing from it moves none of theirs.
        (own,) = self._lap_rng.spawn(1)
        self._variability = Variability(self._options.model_dump(), self._line.length, own)
        self._drawn: Drawn | None = None

    def look(self, sight: Sight) -> None:
        """See the room."""
        self._sight = sight
        self._arc, _ = self._line.locate(sight.pose.x, sight.pose.y, self._arc)

    def assist(self, x: NDArray[np.float64]) -> Assistance:
        """Answer whether to help now, and how; only the user's stick is read from ``x``."""
        if self._sight is None or self._arc is None:
            return NO_ASSISTANCE
        self._fastest = (max(self._fastest[0], self._seen_turning(float(x[1]))), self._fastest[1])
        corner = self._corner_at(self._arc)
        if corner is None or not self._wants_to_help(corner, self._sight, float(x[1])):
            self._acts_at, self._steering = None, None
            self._drawn = None if corner is None else self._drawn
            return self._touch(self._sight.t, self._arc, Command(float(x[0]), float(x[1])))
        if self._acts_at is None:
            self._acts_at = self._sight.t + self._reaction()
        if self._sight.t < self._acts_at:
            return NO_ASSISTANCE
        if self._steering is None:
            pace = min(max(self._options.pace + self._usual.pace, SLOWEST_PACE), 1.0)
            self._steering = CornerSteering(self._line, corner, self._raster, self._lap_rng, pace)
        command = self._steering.steer(self._sight, self._arc)
        command = self._variability.in_steps(self._sight.t, command)
        if self._sight.t < self._acts_at + self._options.h_lag_s:
            return NO_ASSISTANCE  # the hand moves, the signal is not on yet
        return Assistance(helping=True, command=command)

    def _seen_turning(self, stick: float) -> float:
        """Return how fast the stick asks to turn to a side that is watched, rad/s."""
        sides = {"right": -stick, "left": stick, "both": abs(stick)}
        return max(sides[self._options.turns], 0.0)

    def _touch(self, t: float, arc: float, stick: Command) -> Assistance:
        """Take over for a moment, doing as the user does, where no help is needed."""
        if self._variability.touches(t, arc):
            return Assistance(helping=True, command=stick)
        return NO_ASSISTANCE

    @property
    def _usual(self) -> Drawn:
        """What this intervention is like; drawn when a corner comes near."""
        if self._drawn is None:
            self._drawn = self._variability.intervention()
        return self._drawn

    def _corner_at(self, arc: float) -> Stretch | None:
        for corner in self._corners:
            if corner.start - EARLIEST <= arc <= corner.end + LATEST:
                return corner
        return None

    def _wants_to_help(self, corner: Stretch, sight: Sight, stick: float) -> bool:
        to_turn, off = self._through(corner, sight)
        if self._acts_at is not None:
            aligned = ALIGNED * self._usual.release
            return to_turn > aligned or off > 2 * aligned
        side = _sign(corner)
        enough = self._options.enough_rad_s
        if enough is not None and max(self._fastest) >= enough:
            return False
        turning = min(side * stick, side * sight.velocity.w) < TURNING
        begun = self._reached(corner) or (turning and self._seen_near(corner))
        return begun and to_turn > STILL_TO_TURN

    def _seen_near(self, corner: Stretch) -> bool:
        """Whether it has seen, as far as it is off with that, that a turn may begin."""
        off = self._usual.onset_m
        return not off or (self._arc or 0.0) - off >= corner.start - EARLIEST

    def _reached(self, corner: Stretch) -> bool:
        return self._arc is not None and self._arc - self._usual.onset_m >= corner.start

    def _through(self, corner: Stretch, sight: Sight) -> tuple[float, float]:
        """Return how far the chair must turn to point along the next leg, and towards it.

        To the corner's own side, positive.
        """
        side = _sign(corner)
        leg = self._legs[corner.start]
        towards = math.atan2(leg.y - sight.pose.y, leg.x - sight.pose.x)
        return (
            side * math.remainder(sight.pose.heading - leg.heading, math.tau),
            side * math.remainder(sight.pose.heading - towards, math.tau),
        )

    def _reaction(self) -> float:
        noise = self._options.reaction_spread * float(self._lap_rng.normal())
        return self._options.reaction_s * math.exp(noise)


def _watched(line: Centreline, turns: str) -> Iterator[Stretch]:
    for section in line.sections:
        if section.kind == "sharp_right" and turns != "left":
            yield section
        if section.kind == "left" and turns != "right" and _turn(line, section) > SHARP:
            yield section


def _turn(line: Centreline, section: Stretch) -> float:
    """Return how far left the way turns in a section, rad."""
    turned = line.point(section.end).heading - line.point(section.start).heading
    return math.remainder(turned, math.tau)


def _sign(corner: Stretch) -> float:
    """Return 1 for a right turn, -1 for a left one: a left turn is a right turn in a mirror."""
    return -1.0 if corner.kind == "left" else 1.0


def attentive_demonstrator(setup: DemonstratorSetup) -> AttentiveDemonstrator:
    """Return an attentive demonstrator for a course; see ``AttentiveOptions``."""
    options = read_options("demonstrator 'attentive'", AttentiveOptions, setup.options)
    return AttentiveDemonstrator(setup.course, options, setup.rng)
