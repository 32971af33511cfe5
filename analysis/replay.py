"""A recorded lap as a moving picture: nothing is simulated again."""

import io
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Polygon
from PIL import Image

from analysis.figures.plan import draw_plan
from analysis.figures.style import BLACK, BLUE, GREEN, GREY, SKY, VERMILLION, tidy
from analysis.frames import as_frame
from analysis.measures.streams import Numbers, Steps, period, stream
from lad.inputs import N_SEGMENTS
from protocols.course.schema import Course
from protocols.files.errors import InputError
from protocols.record.atomic import write_whole
from protocols.record.reader import open_study
from protocols.wheelchair import FRONT, LASER_AHEAD, REAR, WIDTH

EVERY = 2
"""Steps per frame."""

SPEED = 2.0
"""How much faster than life the picture moves."""

DPI = 80
CONTROL = {"driver": GREY, "demonstrator": BLUE, "model": GREEN}

_BEARINGS = np.deg2rad(-90 + 12 * (np.arange(N_SEGMENTS) + 0.5))


def write_replay(
    study_dir: Path,
    participant: str,
    lap: int,
    out: Path,
    progress: Callable[[str], None] | None = None,
) -> None:
    """Draw a lap as a GIF: the plan with chair, laser and trail, and p(h) against time.

    Parameters
    ----------
    study_dir
        The study directory.
    participant, lap
        Whose lap, and which, counted from 0.
    out
        The file to write; replaced when it exists, never left half-written.
    progress
        Told in a few words what is being done.

    Raises
    ------
    InputError
        When there is no such study, participant or lap, its steps are damaged, or the file's name
        does not end with .gif or it cannot be written.
    """
    out = Path(out)
    if out.suffix.lower() != ".gif":
        raise InputError(f"{out}: is not the name of a GIF; allowed: a name that ends with .gif")
    if not out.parent.is_dir():
        raise InputError(f"{out}: cannot be written: {out.parent}: no such folder")
    study = open_study(Path(study_dir))
    steps = as_frame(study.steps(participant, lap))
    if len(steps) < 2:
        raise InputError(f"{study_dir}: {participant}, lap {lap}: too short to draw; needs 2 steps")
    laps = as_frame(study.laps)
    driven = laps.loc[(laps["participant"] == participant) & (laps["lap"] == lap), "condition"]
    condition = driven.iloc[0] if len(driven) else "?"
    title = f"{participant}, lap {lap}: {condition}"
    frames = _drawn(_Stage(study.course, steps, title), progress or (lambda _: None))
    try:
        write_whole(out, _gif(frames, EVERY * period(steps) / SPEED))
    except OSError as error:
        raise InputError(f"{out}: cannot be written: {error.strerror}") from None


@dataclass(frozen=True, slots=True)
class _Moving:
    """The artists that change from frame to frame."""

    trail: LineCollection
    chair: Polygon
    laser: LineCollection
    clock: Line2D
    said: mpl.text.Text


class _Stage:
    """The figure of one lap, drawn once; only what moves is drawn again."""

    def __init__(self, course: Course, steps: Steps, title: str) -> None:
        self.steps = steps
        self.figure = Figure(figsize=(5.6, 6.4), dpi=DPI, layout="constrained")
        agg: Any = FigureCanvasAgg  # matplotlib leaves its methods untyped
        self.canvas = agg(self.figure)
        plan, chart = self.figure.subplots(2, 1, height_ratios=[4, 1])
        draw_plan(plan, course)
        plan.set_title(title, fontsize=10)
        _legend(plan, steps)
        _chart(chart, steps)
        self._xy = np.column_stack([stream(steps, "x_m"), stream(steps, "y_m")])
        self._links = np.stack([self._xy[:-1], self._xy[1:]], axis=1)
        self._colours = [CONTROL.get(c, BLACK) for c in steps["control"].fillna("?")][1:]
        self._heading = np.nan_to_num(stream(steps, "heading_rad"))
        self._beams = np.column_stack(
            [stream(steps, f"segment_{i:02d}") for i in range(N_SEGMENTS)]
        )
        self.moving = _movers(plan, chart)
        self.canvas.draw()
        for artist in self.artists:
            artist.set_animated(True)
        self.canvas.draw()
        self._background = self.canvas.copy_from_bbox(self.figure.bbox)

    @property
    def artists(self) -> tuple[mpl.artist.Artist, ...]:
        """What moves, from the bottom up."""
        m = self.moving
        return m.laser, m.trail, m.chair, m.clock, m.said

    def frame(self, i: int) -> Image.Image:
        """Return the picture at step i."""
        m, t = self.moving, float(stream(self.steps, "t_s")[i])
        m.trail.set_segments(list(self._links[:i]))
        m.trail.set_color(self._colours[:i])
        m.chair.set_xy(_footprint(self._xy[i], self._heading[i]))
        m.laser.set_segments(_rays(self._xy[i], self._heading[i], self._beams[i]))
        m.clock.set_xdata([t, t])
        m.said.set_text(f"{t:5.1f} s")
        self.canvas.restore_region(self._background)
        for artist in self.artists:
            artist.axes.draw_artist(artist)  # type: ignore[union-attr]  # all of them have axes
        return Image.fromarray(np.asarray(self.canvas.buffer_rgba())).convert("RGB")


def _movers(plan: Axes, chart: Axes) -> _Moving:
    trail = LineCollection([], linewidths=2.2)
    laser = LineCollection([], colors=SKY, linewidths=0.7, alpha=0.8)
    chair = Polygon(np.zeros((4, 2)), closed=True, facecolor="white", edgecolor=BLACK, zorder=5)
    plan.add_collection(laser, autolim=False)
    plan.add_collection(trail, autolim=False)
    plan.add_patch(chair)
    said = plan.text(0.01, 0.01, "", transform=plan.transAxes, fontsize=10, family="monospace")
    clock = chart.axvline(0, color=VERMILLION, linewidth=1.2)
    return _Moving(trail, chair, laser, clock, said)


def _legend(axes: Axes, steps: pd.DataFrame) -> None:
    there = [name for name in CONTROL if (steps["control"] == name).any()]
    lines = [Line2D([], [], color=CONTROL[name], linewidth=2.2) for name in there]
    if lines:
        axes.legend(lines, there, title="in control", loc="lower right", fontsize=8,
                    title_fontsize=8, frameon=False)  # fmt: skip


def _chart(axes: Axes, steps: Steps) -> None:
    t, p, would = stream(steps, "t_s"), stream(steps, "p_help"), stream(steps, "h_would")
    axes.fill_between(t, 0, 1, where=would > 0, color=BLUE, alpha=0.18, linewidth=0, step="post",
                      label="demonstrator would help")  # fmt: skip
    if np.isfinite(p).any():
        axes.plot(t, p, color=GREEN, linewidth=1.2, label="p(h = 1 | x)")
    else:
        axes.text(0.5, 0.5, "no model in this lap", transform=axes.transAxes, ha="center",
                  va="center", fontsize=9, color=GREY)  # fmt: skip
    axes.set_xlim(0, t[-1])
    axes.set_ylim(-0.02, 1.02)
    axes.set_xlabel("t / s", fontsize=9)
    axes.set_ylabel("p(h)", fontsize=9)
    axes.legend(loc="upper right", fontsize=7, frameon=False, ncols=2, bbox_to_anchor=(1, 1.3))
    tidy(axes)


def _turned(points: Numbers, at: Numbers, heading: float) -> Numbers:
    c, s = np.cos(heading), np.sin(heading)
    return np.asarray(at + points @ np.array([[c, s], [-s, c]]))


def _footprint(at: Numbers, heading: float) -> Numbers:
    half = WIDTH / 2
    corners = np.array([[FRONT, -half], [FRONT, half], [-REAR, half], [-REAR, -half]])
    return _turned(corners, at, heading)


def _rays(at: Numbers, heading: float, ranges: Numbers) -> list[Numbers]:
    seen = np.isfinite(ranges)
    ends = np.column_stack([np.cos(_BEARINGS), np.sin(_BEARINGS)]) * ranges[:, None]
    mount = np.array([LASER_AHEAD, 0.0])
    start = _turned(mount[None], at, heading)[0]
    return [np.stack([start, end]) for end in _turned(mount + ends[seen], at, heading)]


def _drawn(stage: _Stage, tell: Callable[[str], None]) -> list[Image.Image]:
    last = len(stage.steps) - 1
    shown = sorted({*range(0, last + 1, EVERY), last})
    frames = []
    for done, i in enumerate(shown):
        if done % 25 == 0:
            tell(f"Drawing frames: {done} of {len(shown)}")
        frames.append(stage.frame(i))
    return frames


def _gif(frames: list[Image.Image], seconds: float) -> bytes:
    """Return the frames as an endless GIF with one palette, so that little changes per frame."""
    palette = _palette(frames[len(frames) // 2])
    flat = [frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in frames]
    stream_ = io.BytesIO()
    flat[0].save(stream_, "GIF", save_all=True, append_images=flat[1:], loop=0, optimize=False,
                 duration=round(1000 * seconds))  # fmt: skip
    return stream_.getvalue()


def _palette(frame: Image.Image) -> Image.Image:
    """Return a palette with the frame's shades and every colour that means something."""
    sample = frame.copy()
    size = max(sample.height // 16, 1)
    for i, colour in enumerate((*CONTROL.values(), SKY, VERMILLION, BLACK, "white")):
        sample.paste(colour, (0, i * 2 * size, 4 * size, (i + 1) * 2 * size))
    return sample.quantize(32, dither=Image.Dither.NONE)
