"""Draw the picture of docs/design.md: ``python bench/design_pictures.py docs/figures``.

Who drives which condition at which place, in a fixed order and in the shipped balanced study, and
how even that makes places.
"""

import sys
from collections import Counter
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from analysis.figures.files import settle, svg
from protocols.load import load_protocol
from protocols.order import laps_of
from protocols.study import StudyProtocol

STUDIES = {"four-lap": "fixed: practice and condition are one", "four-lap-balanced": "Williams"}
COLOURS = {"baseline": "#ffffff", "limited": "#d9d9d9", "human-assisted": "#9ecae1",
         "model-assisted": "#3182bd"}  # fmt: skip
PEOPLE = 12


def main() -> None:
    """Write ``design_orders.svg`` into the folder that is given."""
    figure = Figure(figsize=(7.2, 3.6), layout="constrained")
    for axes, (name, title) in zip(figure.subplots(1, 2), STUDIES.items(), strict=True):
        draw(axes, load_protocol(name), title)
    settle(figure)
    (Path(sys.argv[1]) / "design_orders.svg").write_bytes(svg(figure))


def draw(axes: Axes, protocol: StudyProtocol, title: str) -> None:
    """Draw one row of laps for each participant, and under them how often who was where."""
    orders = [analysed(protocol, number) for number in range(1, PEOPLE + 1)]
    for row, order in enumerate(orders):
        for place, condition in enumerate(order):
            dark = condition == "model-assisted"
            axes.add_patch(Rectangle((place, row), 1, 1, facecolor=COLOURS[condition],
                                     edgecolor="black", linewidth=0.4))  # fmt: skip
            axes.text(place + 0.5, row + 0.52, condition, ha="center", va="center", fontsize=6.5,
                      color="white" if dark else "black")  # fmt: skip
    helped = Counter(order.index("model-assisted") + 1 for order in orders)
    counts = ", ".join(f"{helped[place]}" for place in range(1, len(orders[0]) + 1))
    axes.set_title(title, fontsize=9)
    axes.set_xlabel(f"place; model-assisted is there {counts} times", fontsize=8)
    axes.set_ylabel("participant", fontsize=8)
    axes.set(xlim=(0, len(orders[0])), ylim=(PEOPLE, 0))
    axes.set_xticks(np.arange(len(orders[0])) + 0.5, [str(p + 1) for p in range(len(orders[0]))])
    axes.set_yticks(np.arange(PEOPLE) + 0.5, [str(p + 1) for p in range(PEOPLE)])
    axes.tick_params(length=0, labelsize=7)


def analysed(protocol: StudyProtocol, number: int) -> list[str]:
    """Return a participant's analysed conditions in the order of the laps, with seed 0."""
    return [lap.condition for lap in laps_of(protocol, number, 0) if not lap.practice]


if __name__ == "__main__":
    main()
