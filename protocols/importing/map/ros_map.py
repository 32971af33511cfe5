"""Read a map of ROS's map_server: an image and a YAML file.

Format: https://docs.ros.org/en/humble/ (nav2_map_server); occupancy is ``(255 - value) / 255``, or
``value / 255`` with ``negate``; the image's first row is the top, the origin its lower left corner.
"""

import hashlib
import math
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from pydantic import ConfigDict, Field

from protocols.course.schema import Point
from protocols.files.errors import InputError
from protocols.files.file_model import FileModel
from protocols.importing.mapping_file import read_mapping

MOST_PIXELS = 100_000_000


class RosMapFile(FileModel):
    """A map's YAML file. What other programs add to it is passed over."""

    model_config = ConfigDict(extra="ignore")

    image: Annotated[str, Field(min_length=1)]
    resolution: Annotated[float, Field(ge=0.001, le=1)]
    origin: tuple[float, float, float] | tuple[float, float]
    negate: bool | Literal[0, 1] = 0
    occupied_thresh: Annotated[float, Field(ge=0, le=1)] = 0.65
    free_thresh: Annotated[float, Field(ge=0, le=1)] = 0.196
    mode: Literal["trinary", "scale", "raw"] = "trinary"


@dataclass(frozen=True)
class RosMap:
    """A map as a raster in its own frame; rows along y, from the bottom.

    Attributes
    ----------
    path
        Of the YAML file.
    free, occupied
        Shape (rows, columns): known to be free, known to be an obstacle. Neither: unknown.
    cell
        Edge length of a cell, m.
    origin
        The lower left corner in the world, m, and its direction, rad.
    digest
        SHA-256 of image and YAML file.
    """

    path: Path
    free: NDArray[np.bool_]
    occupied: NDArray[np.bool_]
    cell: float
    origin: tuple[float, float, float]
    digest: str

    @property
    def size(self) -> tuple[float, float]:
        """Width and height, m."""
        rows, columns = self.free.shape
        return columns * self.cell, rows * self.cell

    def inward(self, x: float, y: float) -> Point:
        """Return a point of the world in the map's own frame: m from its lower left corner."""
        ox, oy, yaw = self.origin
        dx, dy = x - ox, y - oy
        cos, sin = math.cos(yaw), math.sin(yaw)
        return cos * dx + sin * dy, cos * dy - sin * dx

    def outward(self, x: float, y: float) -> Point:
        """Return a point of the map's own frame in the world."""
        ox, oy, yaw = self.origin
        cos, sin = math.cos(yaw), math.sin(yaw)
        return ox + cos * x - sin * y, oy + sin * x + cos * y


def read_map(path: Path) -> RosMap:
    """Read a map.

    Parameters
    ----------
    path
        Its YAML file; the image's path in it starts in the file's folder.

    Raises
    ------
    InputError
        When the file or the image cannot be used; names the line.
    """
    head, document = read_mapping(path, RosMapFile)
    where = f"{path}:{document.line(('image',))}: image"
    if head.mode == "raw":
        line = document.line(("mode",))
        raise InputError(f"{path}:{line}: mode: 'raw' has no scale; allowed: trinary, scale")
    if not head.free_thresh < head.occupied_thresh:
        line = document.line(("free_thresh",))
        raise InputError(
            f"{path}:{line}: free_thresh: {head.free_thresh:g}; allowed: below occupied_thresh "
            f"({head.occupied_thresh:g})"
        )
    image = path.parent / head.image
    grey, known = _pixels(image, where)
    occupancy = grey if head.negate else 1.0 - grey
    digest = hashlib.sha256(path.read_bytes() + image.read_bytes()).hexdigest()
    yaw = head.origin[2] if len(head.origin) == 3 else 0.0
    return RosMap(
        path=path,
        free=np.flipud(known & (occupancy < head.free_thresh)),
        occupied=np.flipud(known & (occupancy > head.occupied_thresh)),
        cell=head.resolution,
        origin=(head.origin[0], head.origin[1], yaw),
        digest=digest,
    )


def _pixels(image: Path, where: str) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
    """Return an image's brightness, 0 to 1, and which pixels are not transparent."""
    try:
        with Image.open(image) as picture:
            if picture.width * picture.height > MOST_PIXELS:
                raise InputError(
                    f"{where}: {picture.width} x {picture.height} pixels; allowed: {MOST_PIXELS}"
                )
            if picture.mode == "F":
                raise InputError(f"{where}: {image} has real numbers; allowed: 8 or 16 bits")
            if picture.mode.startswith("I"):  # converted, 16 bits would be cut off at 255
                deep = np.asarray(picture, dtype=np.float64) / 65535
                return deep, np.ones(deep.shape, dtype=np.bool_)
            grey = np.asarray(picture.convert("LA"), dtype=np.float64) / 255
    except FileNotFoundError:
        raise InputError(f"{where}: there is no file {image}; allowed: a PGM or PNG") from None
    except (OSError, ValueError, Image.DecompressionBombError) as error:
        raise InputError(f"{where}: {image} cannot be read as an image: {error}") from None
    return grey[:, :, 0], grey[:, :, 1] > 0.5
