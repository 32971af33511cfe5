"""Maps as a robot would draw them."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from protocols.course.occupancy import occupancy
from protocols.load import load_course


@pytest.fixture(scope="session")
def draw_course() -> Callable[..., Path]:
    """Return the function that draws a shipped course as a map; returns the map's YAML file."""

    def draw(folder: Path, name: str = "lab-office", cell: float = 0.05) -> Path:
        raster = occupancy(load_course(name), cell)
        grey = np.where(raster.free, 254, 0).astype(np.uint8)
        Image.fromarray(np.flipud(grey)).save(folder / "map.pgm")
        x, y = (middle - cell / 2 for middle in raster.origin)
        (folder / "map.yaml").write_text(
            f"image: map.pgm\nresolution: {cell}\norigin: [{x}, {y}, 0.0]\nnegate: 0\n"
            "occupied_thresh: 0.65\nfree_thresh: 0.196\n"
        )
        return folder / "map.yaml"

    return draw


ROUTE = """\
schema: 1
name: again
start: {x: 0.0, y: 0.0, heading: 0.0}
via:
  - [2.3, -0.4]
  - [-2.95, -5.53]
  - [-0.5, 0.0]
gates: [R1, R2, F]
"""


@pytest.fixture
def route(tmp_path: Path) -> Callable[..., Path]:
    """Return the function that writes a route through lab-office, with changes."""

    def write(**changes: str) -> Path:
        text = ROUTE
        for before, after in changes.items():
            start = text.index(f"{before}:")
            rest = text[start:].partition("\n")[2]
            while rest.startswith(" "):
                rest = rest.partition("\n")[2]
            text = f"{text[:start]}{after}\n{rest}"
        (tmp_path / "route.yaml").write_text(text)
        return tmp_path / "route.yaml"

    return write
