"""How exactly the chair is placed at the start of a lap."""

from typing import Annotated

from pydantic import Field

from protocols.files.file_model import FileModel


class StartNoise(FileModel):
    """How far from the course's start pose a lap may begin; drawn uniformly for each lap.

    Attributes
    ----------
    position_m
        Largest error of either coordinate, m.
    heading_rad
        Largest error of the heading, rad.
    """

    position_m: Annotated[float, Field(ge=0, le=0.3)] = 0.0
    heading_rad: Annotated[float, Field(ge=0, le=0.5)] = 0.0
