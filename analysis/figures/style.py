"""How every figure looks: size, colours, type."""

from collections.abc import Sequence

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from analysis.roles import Part, Role

# Okabe & Ito (2008), Color Universal Design: distinct with every common colour blindness.
BLACK, ORANGE, SKY, GREEN = "#000000", "#E69F00", "#56B4E9", "#009E73"
YELLOW, BLUE, VERMILLION, PURPLE = "#F0E442", "#0072B2", "#D55E00", "#CC79A7"
GREY, LIGHT = "#6b6b6b", "#d9d9d9"

ROLE_COLOURS: dict[Role, str] = {
    "baseline": GREY,
    "limited": ORANGE,
    "demonstrator": BLUE,
    "model": GREEN,
}
_FURTHER = (VERMILLION, PURPLE, SKY, BLACK)

WIDTH = 5.6
"""Width of a figure, inches."""


def colours(parts: Sequence[Part]) -> dict[str, str]:
    """Return each condition's colour: its role's, and further ones where roles repeat."""
    taken: dict[str, str] = {}
    spare = iter(_FURTHER * len(parts))
    for part in parts:
        wanted = ROLE_COLOURS[part.role]
        taken[part.condition] = next(spare) if wanted in taken.values() else wanted
    return taken


def new_figure(height: float, width: float = WIDTH) -> Figure:
    """Return an empty figure with automatic spacing; sizes in inches."""
    return Figure(figsize=(width, height), layout="constrained")


def tidy(axes: Axes, *, grid: str | None = None) -> None:
    """Remove what carries no data; keep a faint grid along one axis where one is asked for."""
    axes.spines[["top", "right"]].set_visible(False)
    axes.tick_params(labelsize=9)
    if grid == "x":
        axes.grid(axis="x", color=LIGHT, linewidth=0.6)
    elif grid == "y":
        axes.grid(axis="y", color=LIGHT, linewidth=0.6)
    axes.set_axisbelow(True)


def say_nothing_to_show(figure: Figure, why: str) -> Figure:
    """Write the reason in place of the data."""
    figure.text(0.5, 0.5, why, ha="center", va="center", fontsize=10, color=GREY, wrap=True)
    return figure
