"""What a mapping file for recordings may say: which topic is what."""

import re
from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from protocols.files.file_model import FileModel, Name

Topic = Annotated[str, Field(pattern=r"^[A-Za-z~/][A-Za-z0-9_/~]*$", max_length=200)]


class Transform(FileModel):
    """Where the origin of the recorded poses' frame lies in the course, in m and rad."""

    x: float = 0.0
    y: float = 0.0
    yaw: float = 0.0


class PoseSource(FileModel):
    """Where the chair is. Odometry alone drifts: it is no pose in the map.

    Attributes
    ----------
    topic
        Odometry, PoseStamped or PoseWithCovarianceStamped.
    frame
        The frame the poses must be in; null: not checked.
    transform
        From that frame to the course's.
    ahead_of_axle_m
        How far the recorded point is ahead of the midpoint of the driven axle.
    """

    topic: Topic
    frame: str | None = None
    transform: Transform = Transform()
    ahead_of_axle_m: Annotated[float, Field(ge=-2, le=2)] = 0.0


class Stick(FileModel):
    """How a joystick's axes become a command: ``scale * axes[axis]``; left turns are positive."""

    axis_v: Annotated[int, Field(ge=0, le=20)] = 1
    axis_w: Annotated[int, Field(ge=0, le=20)] = 0
    scale_v: float = 0.7
    scale_w: float = 0.5


class CommandSource(FileModel):
    """A stream of commands: Twist, TwistStamped, Odometry's velocity, or a joystick (Joy)."""

    topic: Topic
    stick: Stick = Stick()


class ScanSource(FileModel):
    """The laser.

    Attributes
    ----------
    topic
        LaserScan.
    forward_rad
        The chair's forward direction in the scan's frame.
    upside_down
        Whether the laser is mounted upside down: its angles then count to the right.
    """

    topic: Topic
    forward_rad: float = 0.0
    upside_down: bool = False


class SignalSource(FileModel):
    """A signal that is on where a number is above a limit, or a text is one of some.

    Attributes
    ----------
    topic
        Bool, a number, a text (String), or a joystick's button.
    above
        The signal is on where the number is above it.
    texts
        The signal is on where the text is one of these.
    button
        Of a joystick, counted from 0.
    """

    topic: Topic
    above: float = 0.5
    texts: tuple[str, ...] = ()
    button: Annotated[int, Field(ge=0, le=40)] = 0


class Marks(FileModel):
    """When a lap begins.

    Attributes
    ----------
    topic
        Whose messages mark it.
    text
        Regular expression that the message's text contains, for a String.
    """

    topic: Topic
    text: str | None = None

    @model_validator(mode="after")
    def _is_an_expression(self) -> Self:
        try:
            re.compile(self.text or "")
        except re.error as error:
            raise ValueError(f"text: not a regular expression: {error}") from None
        return self


class Person(FileModel):
    """Who sat in the chair.

    Attributes
    ----------
    laps
        The conditions of the laps in the order in which this person drove them; null for the
        protocol's order.
    """

    participant: Annotated[str, Field(pattern=r"^P\d{4}$")]
    kind: Literal["live", "synthetic", "scripted"] = "live"
    consented: bool = True
    laps: Annotated[tuple[Name, ...], Field(min_length=1, max_length=200)] | None = None
    age_years: Annotated[int, Field(ge=0, le=120)] | None = None
    gender: Literal["female", "male", "other", "undisclosed"] | None = None
    handedness: Literal["right", "left", "both", "undisclosed"] | None = None


class BagMapping(FileModel):
    """What is what in a wheelchair's recordings.

    Attributes
    ----------
    protocol
        The study that was driven: a shipped protocol's name or a file, for conditions and laps.
    course
        The course, when it is not the protocol's.
    people
        Who is in which recording, by the recording's name without its ending; P0001, P0002, ... in
        the order of the command line when not given.
    clock
        The time of a message: its header's, or when it was recorded. Messages without a header
        have the latter only.
    pose, velocity, scan, executed, intent
        Streams that every recording must have. ``velocity`` and ``limited`` may be left out: the
        pose's topic then has the velocity, and the limitation is computed from the intent.
    arbitrated
        The command before a safeguard; null: as executed.
    takeover, demonstrator
        The demonstrator's signal and command; null for a study without one.
    assisted
        Whether the assistant's command counted; null: it did where the demonstrator helped or the
        model, computed again, would have.
    contact
        Whether the chair touched something; null: where its outline overlaps an obstacle.
    starts
        What marks the beginning of a lap; the laps are the protocol's in their order.
    largest_gap_s
        Between two messages of a stream; longer gaps are named.
    model
        Whether the model's predictions are computed again, and learnt in training laps.
    """

    schema_version: Annotated[Literal[1], Field(alias="schema")] = 1
    protocol: Annotated[str, Field(min_length=1)] = "four-lap"
    course: str | None = None
    people: dict[str, Person] = Field(default_factory=dict)
    clock: Literal["header", "recorded"] = "header"
    pose: PoseSource
    velocity: CommandSource | None = None
    scan: ScanSource
    executed: CommandSource
    intent: CommandSource
    limited: CommandSource | None = None
    arbitrated: CommandSource | None = None
    takeover: SignalSource | None = None
    demonstrator: CommandSource | None = None
    assisted: SignalSource | None = None
    contact: SignalSource | None = None
    starts: Marks
    largest_gap_s: Annotated[float, Field(gt=0, le=60)] = 0.5
    model: Literal["recompute", "none"] = "recompute"

    @model_validator(mode="after")
    def _takeover_has_commands(self) -> Self:
        if (self.takeover is None) != (self.demonstrator is None):
            raise ValueError("takeover and demonstrator belong together: give both, or neither")
        return self

    @property
    def demonstrated(self) -> bool:
        """Whether there is a demonstrator."""
        return self.takeover is not None
