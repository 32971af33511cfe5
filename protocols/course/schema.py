"""A course as data: the fields of a course file."""

import itertools
import math
from collections.abc import Iterator
from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from protocols.files.fault import Fault, InconsistentError, Location
from protocols.files.file_model import FileModel, FormatVersion, Name

Metres = Annotated[float, Field(ge=-1000, le=1000)]
Point = tuple[Metres, Metres]
SectionKind = Literal["straight", "sharp_right", "soft_right", "left"]

MIN_STEP = 1e-3
"""Points of a polyline closer than this count as the same, m."""


class Wall(FileModel):
    """A wall along a polyline; its faces stand half a thickness to either side.

    Attributes
    ----------
    name
        What the wall is called in messages.
    points
        Corners of the polyline, each [x, y] in m.
    closed
        Whether a last piece leads back to the first corner.
    thickness, height
        Of the wall, in m.
    """

    name: Name
    points: Annotated[tuple[Point, ...], Field(min_length=2, max_length=1000)]
    closed: bool = False
    thickness: Annotated[float, Field(gt=0, le=1)] = 0.1
    height: Annotated[float, Field(gt=0, le=5)] = 1.2


class Furniture(FileModel):
    """A box on the floor: centre, heading of its length, and size in metres.

    Attributes
    ----------
    name
        What the piece is called in messages.
    x, y
        Its centre, in m.
    heading
        Direction of its length, in rad, anticlockwise from the x axis.
    length, width, height
        Its size, in m.
    """

    name: Name
    x: Metres
    y: Metres
    heading: float = 0.0
    length: Annotated[float, Field(gt=0, le=10)]
    width: Annotated[float, Field(gt=0, le=10)]
    height: Annotated[float, Field(gt=0, le=5)] = 0.8


class Start(FileModel):
    """Where a lap starts: the midpoint of the driven axle and the heading in radians.

    Attributes
    ----------
    x, y
        The midpoint of the driven axle, in m.
    heading
        Where the chair looks, in rad, anticlockwise from the x axis.
    """

    x: Metres
    y: Metres
    heading: float


class Gate(FileModel):
    """A line to cross; gates count only in their order.

    Attributes
    ----------
    name
        Unique name; the record names the gate by it.
    left, right
        Ends of the line, seen in the direction of travel, each [x, y] in m.
    """

    name: Name
    left: Point
    right: Point


class Section(FileModel):
    """A stretch of the centreline, up to an arc length in metres (the last one: to the end).

    Attributes
    ----------
    name
        Unique name; tables and figures show it.
    kind
        What the driver has to do there; sharp right turns are what the paper limits.
    until
        Arc length along the centreline at which it ends, in m; null for the last one.
    """

    name: Name
    kind: SectionKind
    until: Annotated[float, Field(gt=0)] | None = None


class Course(FileModel):
    """Walls, furniture, start, ordered gates and a centreline cut into labelled sections.

    The centreline is for metrics and for drivers with a map; it ends at the last gate.

    Attributes
    ----------
    schema_version
        Version of the file format; ``schema`` in a file.
    name, title
        What the course is called: the name stands in the record, the title in the report.
    description
        What the course is like, and where it comes from.
    walls, furniture
        What the chair can hit, and what the laser sees.
    start
        Where a lap starts.
    gates
        In the order in which they must be crossed; a lap ends at the last one.
    centreline
        The way through the gates, each point [x, y] in m.
    sections
        The centreline cut into labelled stretches, in order.
    """

    schema_version: Annotated[Literal[1], FormatVersion, Field(alias="schema")] = 1
    name: Name
    title: Annotated[str, Field(max_length=5000)]
    description: str = ""
    walls: Annotated[tuple[Wall, ...], Field(min_length=1, max_length=1000)]
    furniture: Annotated[tuple[Furniture, ...], Field(max_length=2000)] = ()
    start: Start
    gates: Annotated[tuple[Gate, ...], Field(min_length=1, max_length=100)]
    centreline: Annotated[tuple[Point, ...], Field(min_length=2, max_length=10_000)]
    sections: Annotated[tuple[Section, ...], Field(min_length=1, max_length=500)]

    @model_validator(mode="after")
    def _parts_agree(self) -> Self:
        faults = (*self._degenerate(), *self._repeated_names(), *self._uncovered())
        if faults:
            raise InconsistentError(faults)
        return self

    def _degenerate(self) -> Iterator[Fault]:
        """Find lines of no length."""
        for i, wall in enumerate(self.walls):
            yield from _repeated_points(wall.points, ("walls", i, "points"))
            if wall.closed and math.dist(wall.points[0], wall.points[-1]) < MIN_STEP:
                message = "a closed wall ends at its first point; leave out its last point"
                yield Fault(("walls", i, "points", len(wall.points) - 1), message)
        for i, gate in enumerate(self.gates):
            if math.dist(gate.left, gate.right) < MIN_STEP:
                yield Fault(("gates", i), f"gate {gate.name}: left and right are the same point")
        yield from _repeated_points(self.centreline, ("centreline",))

    def _repeated_names(self) -> Iterator[Fault]:
        """Find gates or sections with the same name in the record."""
        for field, parts in (("gates", self.gates), ("sections", self.sections)):
            names = [part.name for part in parts]
            for i, name in enumerate(names):
                if name in names[:i]:
                    yield Fault((field, i, "name"), f"'{name}' is used twice; names must differ")

    def _uncovered(self) -> Iterator[Fault]:
        """Find sections that do not follow one another to the centreline's end."""
        length = sum(math.dist(a, b) for a, b in itertools.pairwise(self.centreline))
        reached = 0.0
        for i, section in enumerate(self.sections[:-1]):
            where = ("sections", i, "until")
            if section.until is None:
                yield Fault(
                    where, f"section '{section.name}' needs it; only the last may go without"
                )
            elif not reached < section.until < length:
                yield Fault(
                    where,
                    f"section '{section.name}' ends at {section.until:g} m; allowed: above "
                    f"{reached:g} m, below the centreline's length of {length:.2f} m",
                )
            reached = section.until or reached
        last = self.sections[-1]
        if last.until is not None and abs(last.until - length) > 0.01:
            yield Fault(
                ("sections", len(self.sections) - 1, "until"),
                f"section '{last.name}' is the last and must end with the centreline, at "
                f"{length:.2f} m; leave 'until' out",
            )


def _repeated_points(points: tuple[Point, ...], where: Location) -> Iterator[Fault]:
    for i, (a, b) in enumerate(itertools.pairwise(points), start=1):
        if math.dist(a, b) < MIN_STEP:
            yield Fault((*where, i), "repeats the point before it")
