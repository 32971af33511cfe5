"""When to help, with the threshold swept (the paper's Figure 4a)."""

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from analysis.figures.style import BLUE, GREEN, GREY, ORANGE, new_figure, tidy
from analysis.reproduction.accuracy import pooled
from analysis.reproduction.teaching import Run

THRESHOLD = 0.5
"""The paper's W_h."""


def roc_curve(
    p_help: NDArray[np.float64], helped: NDArray[np.bool_]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return false and true positive rates as the threshold on p(h) falls from above 1 to 0.

    Examples
    --------
    >>> false, true = roc_curve(np.array([0.9, 0.8, 0.1]), np.array([True, False, False]))
    >>> false.tolist(), true.tolist()
    ([0.0, 0.0, 0.5, 1.0], [0.0, 1.0, 1.0, 1.0])
    """
    falling = np.argsort(-p_help, kind="stable")
    scores, positive = p_help[falling], helped[falling]
    last_of_ties = np.flatnonzero(np.append(np.diff(scores) != 0, values=True))
    true = np.cumsum(positive)[last_of_ties] / max(1, positive.sum())
    false = np.cumsum(~positive)[last_of_ties] / max(1, (~positive).sum())
    return np.concatenate([[0.0], false]), np.concatenate([[0.0], true])


def roc_figure(runs: Sequence[Run]) -> Figure:
    """Draw ROC curves pooled over runs after 0, 1 and all demonstrations; W_h = 0.5 is marked."""
    figure = new_figure(3.6, 7.0)
    whole, corner = figure.subplots(1, 2)
    last = len(runs[0]) - 1
    for demonstrations, colour, line in ((0, GREY, ":"), (1, ORANGE, "--"), (last, BLUE, "-")):
        p_help, helped = pooled(runs, demonstrations)
        false, true = roc_curve(p_help, helped)
        chosen = p_help >= THRESHOLD
        at = float(chosen[~helped].mean()), float(chosen[helped].mean())
        label = "first lap" if demonstrations == 0 else f"after {demonstrations}"
        for axes in (whole, corner):
            axes.plot(false, true, color=colour, linestyle=line, linewidth=1.7, label=label)
            axes.scatter(*at, color=colour, s=26, zorder=4)
    whole.plot([0, 1], [0, 1], color=GREEN, linewidth=0.8, linestyle=":", label="chance")
    whole.scatter([], [], color=GREY, s=26, label="W_h = 0.5")
    whole.set_xlim(-0.02, 1.02)
    whole.set_ylim(-0.02, 1.02)
    corner.set_xlim(-0.003, 0.15)
    corner.set_ylim(0.8, 1.005)
    corner.set_title("the upper left corner", fontsize=9)
    for axes in (whole, corner):
        axes.set_xlabel("helping although the demonstrator was not")
        tidy(axes, grid="y")
    whole.set_ylabel("helping when the demonstrator was")
    whole.legend(frameon=False, fontsize=8, loc="lower right")
    return figure
