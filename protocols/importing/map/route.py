"""What a route file may say: where through a map a course leads, and how walls are simplified."""

from typing import Annotated, Literal

from pydantic import Field

from protocols.course.schema import Metres, Point, Start
from protocols.files.file_model import FileModel, Name


class Simplification(FileModel):
    """How a map's cells become walls.

    Attributes
    ----------
    tolerance_m
        How far a wall may be from the map's, m.
    closing_m
        Gaps between obstacles narrower than this are closed, m.
    specks_m2
        Obstacles smaller than this are dropped, m^2.
    reach_m
        How far from the route walls are kept, m: beyond the laser's range nobody sees them.
    """

    tolerance_m: Annotated[float, Field(ge=0.01, le=0.5)] = 0.06
    closing_m: Annotated[float, Field(ge=0, le=0.5)] = 0.12
    specks_m2: Annotated[float, Field(ge=0, le=1)] = 0.02
    reach_m: Annotated[float, Field(ge=4.1, le=20)] = 5.0


class Route(FileModel):
    """A route through a map; all points in the map's world, in metres.

    Attributes
    ----------
    start
        Where the axle's midpoint stands at the start, and the heading, rad.
    via
        Points to pass, in order; a gate stands at each, the last one is the finish.
    gates
        Name of the gate at each via; null where none stands and the point only leads the route. The
        numbers 1, 2, ... when not given.
    clearance_m
        The route keeps this far from obstacles where there is room, m.
    widest_gate_m
        A gate in an open space reaches so far to either side, m.
    unknown
        What the map does not know counts as a wall, or as free.
    """

    schema_version: Annotated[Literal[1], Field(alias="schema")] = 1
    name: Name
    title: str = ""
    start: Start
    via: Annotated[tuple[Point, ...], Field(min_length=1, max_length=50)]
    gates: tuple[Name | None, ...] | None = None
    clearance_m: Annotated[float, Field(ge=0.3, le=3)] = 0.8
    widest_gate_m: Annotated[Metres, Field(ge=0.5, le=10)] = 2.5
    unknown: Literal["wall", "free"] = "wall"
    simplify: Simplification = Simplification()
