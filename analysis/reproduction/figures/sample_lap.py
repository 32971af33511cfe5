"""What a taught model predicts during a test lap (the paper's Figure 4d)."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from analysis.figures.style import BLACK, BLUE, GREY, LIGHT, VERMILLION, new_figure, tidy
from analysis.measures.episodes import episodes
from analysis.reproduction.anticipation import RISEN
from analysis.reproduction.figures.roc import THRESHOLD
from analysis.reproduction.teaching import PredictedLap


def sample_lap_figure(lap: PredictedLap) -> Figure:
    """Draw p(h), the predicted command with its standard deviation, and the demonstrator's."""
    figure = new_figure(6.0, 7.0)
    when, linear, turning = figure.subplots(3, 1, sharex=True)
    for axes in (when, linear, turning):
        for begin, end in episodes(lap.helped):
            stop = lap.t[min(end, len(lap.t) - 1)]
            axes.axvspan(lap.t[begin], stop, color=LIGHT, alpha=0.7, linewidth=0, zorder=0)
        tidy(axes, grid="y")
    when.plot(lap.t, lap.p_help, color=BLUE, linewidth=1.3, label="p(h = 1 | x)")
    when.axhline(THRESHOLD, color=GREY, linewidth=0.8, linestyle="--", label="W_h = 0.5")
    when.axhline(RISEN, color=GREY, linewidth=0.8, linestyle=":", label="0.25")
    when.fill_between([], [], color=LIGHT, alpha=0.7, label="demonstrator helps")
    when.set_ylim(-0.03, 1.03)
    when.set_ylabel("p(h = 1 | x)")
    _command(linear, lap, 0, "a_v / m/s")
    _command(turning, lap, 1, "a_w / rad/s")
    turning.set_xlabel("time since the start of the lap / s")
    turning.set_xlim(float(lap.t[0]), float(lap.t[-1]))
    when.legend(frameon=False, fontsize=8, loc="upper center", ncols=4, bbox_to_anchor=(0.5, 1.25))
    linear.legend(frameon=False, fontsize=8, loc="upper center", ncols=3, bbox_to_anchor=(0.5, 1.2))
    return figure


def _command(axes: Axes, lap: PredictedLap, component: int, label: str) -> None:
    mean, sd = lap.mean[:, component], np.sqrt(lap.variance)
    axes.fill_between(lap.t, mean - sd, mean + sd, color=VERMILLION, alpha=0.25, linewidth=0,
                      label="± 1 sd")  # fmt: skip
    axes.plot(lap.t, mean, color=VERMILLION, linewidth=1.3, label="predicted")
    axes.plot(lap.t, lap.action[:, component], color=BLACK, linewidth=1.3, linestyle="--",
              label="demonstrator")  # fmt: skip
    axes.set_ylabel(label)
