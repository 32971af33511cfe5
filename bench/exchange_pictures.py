"""Draw the pictures of docs/exchange.md: ``python bench/exchange_pictures.py docs/figures``.

The map is lab-office as a robot could have drawn it: a ragged outline, specks, unknown outside.
"""

import sys
import tempfile
from pathlib import Path

import numpy as np
from PIL import Image
from scipy import ndimage

from analysis.figures.files import png
from analysis.figures.imported_map import map_with_course, map_with_grid
from protocols.course.occupancy import occupancy
from protocols.importing.map.course import import_course
from protocols.importing.map.ros_map import read_map
from protocols.load import load_course

ROUTE = """\
schema: 1
name: office-loop
title: Office loop
start: {x: 0.0, y: 0.0, heading: 0.0}
via:
  - [2.3, -0.4]
  - [-2.95, -5.53]
  - [-0.5, 0.0]
gates: [R1, R2, F]
"""


def draw_map(folder: Path) -> Path:
    """Draw the map; return its YAML file."""
    rng = np.random.default_rng(1)
    raster = occupancy(load_course("lab-office"), 0.05)
    labels, _ = ndimage.label(raster.free)
    inside = labels == labels[raster.index(0.0, 0.0)]
    grey = np.where(inside, 254, 205).astype(np.uint8)
    edge = ndimage.binary_dilation(inside, iterations=2) & ~inside
    grey[edge & (rng.random(edge.shape) < 0.9)] = 0
    grey[inside & (rng.random(edge.shape) < 0.002)] = 0
    Image.fromarray(np.flipud(grey)).save(folder / "office.pgm")
    x, y = (middle - 0.025 for middle in raster.origin)
    head = f"image: office.pgm\nresolution: 0.05\norigin: [{x:.3f}, {y:.3f}, 0.0]\nnegate: 0\n"
    (folder / "office.yaml").write_text(head)
    return folder / "office.yaml"


def main(out: Path) -> None:
    """Write both pictures."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        drawn = read_map(draw_map(folder))
        (folder / "route.yaml").write_text(ROUTE)
        done = import_course(drawn, folder / "route.yaml")
    for name, figure in (
        ("import_map_grid", map_with_grid(drawn)),
        ("import_map_course", map_with_course(drawn, done.course)),
    ):
        figure.set_size_inches(6, 6)
        figure.set_dpi(80)
        (out / f"{name}.png").write_bytes(png(figure))
        print(f"{name}: {[bend.kind for bend in done.bends]}, {done.specks} specks dropped")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
