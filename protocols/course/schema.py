"""A course as data: what a course file may say."""

from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field

Point = tuple[float, float]
SectionKind = Literal["straight", "sharp_right", "soft_right", "left"]
Name = Annotated[str, Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9 _.-]*$")]


class _Part(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)


class Wall(_Part):
    """A wall along a polyline; its faces stand half a thickness to either side."""

    name: Name
    points: Annotated[tuple[Point, ...], Field(min_length=2)]
    closed: bool = False
    thickness: Annotated[float, Field(gt=0, le=1)] = 0.1
    height: Annotated[float, Field(gt=0, le=5)] = 1.2


class Furniture(_Part):
    """A box on the floor: centre, heading of its length, and size in metres."""

    name: Name
    x: float
    y: float
    heading: float = 0.0
    length: Annotated[float, Field(gt=0, le=10)]
    width: Annotated[float, Field(gt=0, le=10)]
    height: Annotated[float, Field(gt=0, le=5)] = 0.8


class Start(_Part):
    """Where a lap starts: the midpoint of the driven axle and the heading in radians."""

    x: float
    y: float
    heading: float


class Gate(_Part):
    """A line to cross; gates count only in their order."""

    name: Name
    left: Point
    right: Point


class Section(_Part):
    """A stretch of the centreline, up to an arc length in metres (the last one: to the end)."""

    name: Name
    kind: SectionKind
    until: Annotated[float, Field(gt=0)] | None = None


class Course(_Part):
    """Walls, furniture, start, ordered gates and a centreline cut into labelled sections.

    The centreline is for metrics and for drivers with a map; it ends at the last gate.
    """

    schema_version: Annotated[Literal[1], Field(alias="schema")] = 1
    name: Name
    title: str
    description: str = ""
    walls: Annotated[tuple[Wall, ...], Field(min_length=1)]
    furniture: tuple[Furniture, ...] = ()
    start: Start
    gates: Annotated[tuple[Gate, ...], Field(min_length=1)]
    centreline: Annotated[tuple[Point, ...], Field(min_length=2)]
    sections: Annotated[tuple[Section, ...], Field(min_length=1)]
