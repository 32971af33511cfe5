"""A recorded lap as an animated picture, without another simulation."""

import io
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
import pandas as pd
import pyarrow.compute as pc
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Polygon
from PIL import Image

from analysis.figures.plan import draw_plan
from analysis.figures.style import BLACK, BLUE, GREEN, GREY, SKY, VERMILLION, tidy
from analysis.figures.text import literal_text, wrapped
from analysis.frames import as_frame
from analysis.measures.streams import Numbers, Steps, stream
from lad.inputs import N_SEGMENTS
from protocols.course.schema import Course
from protocols.files.errors import InputError
from protocols.record.atomic import write_whole
from protocols.record.reader import Study, open_study
from protocols.wheelchair import FRONT, LASER_AHEAD, REAR, WIDTH

FRAME_S = 0.1
"""How long a frame is shown, s. Browsers show one of less than 0.02 s for 0.1 s."""

SPEED = 2.0
"""How many times faster than real time the picture moves."""

_FRAME_APART = SPEED * FRAME_S

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
        The participant's id, and the lap, counted from 0.
    out
        The file to write; replaced when it exists, never left half-written.
    progress
        Called with a few words about what is being done.

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
    table, _, placement = study.lap_steps(participant, lap, against_lap=False)
    steps = as_frame(table)
    if len(steps) < 2:
        raise InputError(f"{study_dir}: {participant}, lap {lap}: too short to draw; needs 2 steps")
    shown = shown_steps(stream(steps, "t_s"))
    if shown is None:
        raise InputError(
            f"{study_dir}: {participant}, lap {lap}: its steps have no times that go on; a replay "
            "needs them"
        )
    title = wrapped(f"{participant}, lap {lap}: {_condition(study, participant, lap)}", 60, lines=4)
    if not placement.on_course:
        title += "\n(its positions do not fit the course)"
    with literal_text():
        stage = _Stage(study.course_of(participant), steps, title)
        frames = _drawn(stage, list(shown), progress or (lambda _: None))
    try:
        write_whole(out, _gif(frames, list(shown.values())))
    except OSError as error:
        raise InputError(f"{out}: cannot be written: {error.strerror}") from None


def shown_steps(t: Numbers) -> dict[int, int] | None:
    """Return the steps to be shown, and for how many frames, so that time runs at ``SPEED``.

    Parameters
    ----------
    t
        Times of the steps, s, shape (n,); NaN where missing, not always increasing.

    Returns
    -------
    dict[int, int] or None
        By step, the number of frames: in each the last step that had begun when its time came, and
        the lap's last one at the end; None when time does not go on.

    Examples
    --------
    >>> shown_steps(np.arange(0, 1.0, 0.1))
    {0: 1, 2: 1, 4: 1, 6: 1, 8: 1, 9: 1}
    >>> shown_steps(np.array([0.0, 0.1, 0.8]))
    {0: 1, 1: 3, 2: 1}
    """
    known = np.flatnonzero(np.isfinite(t))
    if len(known) < 2 or not t[known].max() > t[known[0]]:
        return None
    latest = np.maximum.accumulate(t[known])
    times = latest[0] + _FRAME_APART * np.arange(int((latest[-1] - latest[0]) / _FRAME_APART) + 1)
    # A step that begins at a frame's time is shown in it, whatever the last digit of either.
    at = np.searchsorted(latest, times + 1e-6, side="right") - 1
    shown = Counter(int(i) for i in known[at])
    shown.setdefault(int(known[-1]), 1)
    return dict(sorted(shown.items()))


def _condition(study: Study, participant: str, lap: int) -> str:
    """Return a lap's condition as it was recorded; ? when the lap has no row."""
    laps = study.laps
    rows = pc.and_(pc.equal(laps["participant"], participant), pc.equal(laps["lap"], lap))
    found = laps.filter(rows)["condition"].to_pylist()
    return found[0] if found else "?"


@dataclass(frozen=True, slots=True)
class _Moving:
    """The artists that change from frame to frame."""

    trail: LineCollection
    chair: Polygon
    laser: LineCollection
    clock: Line2D
    label: mpl.text.Text


class _Stage:
    """The figure of one lap, drawn once; only the moving artists are drawn again."""

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
        """The moving artists, from the bottom up."""
        m = self.moving
        return m.laser, m.trail, m.chair, m.clock, m.label

    def frame(self, i: int) -> Image.Image:
        """Return the picture at step i."""
        m, t = self.moving, float(stream(self.steps, "t_s")[i])
        m.trail.set_segments(list(self._links[:i]))
        m.trail.set_color(self._colours[:i])
        m.chair.set_xy(_footprint(self._xy[i], self._heading[i]))
        m.laser.set_segments(_rays(self._xy[i], self._heading[i], self._beams[i]))
        m.clock.set_xdata([t, t])
        m.label.set_text(f"{t:5.1f} s")
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
    label = plan.text(0.01, 0.01, "", transform=plan.transAxes, fontsize=10, family="monospace")
    clock = chart.axvline(0, color=VERMILLION, linewidth=1.2)
    return _Moving(trail, chair, laser, clock, label)


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
    axes.set_xlim(min(0.0, float(np.nanmin(t))), float(np.nanmax(t)))
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


def _drawn(stage: _Stage, shown: Sequence[int], tell: Callable[[str], None]) -> list[Image.Image]:
    frames = []
    for done, i in enumerate(shown):
        if done % 25 == 0:
            tell(f"Drawing frames: {done} of {len(shown)}")
        frames.append(stage.frame(i))
    return frames


def _gif(frames: list[Image.Image], lasting: list[int]) -> bytes:
    """Return the frames as an endless GIF with one palette, so that little changes per frame.

    Each lasts for so many times ``FRAME_S``; the format counts hundredths of a second, 65535 at
    most.
    """
    palette = _palette(frames[len(frames) // 2])
    flat = [frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in frames]
    stream_ = io.BytesIO()
    flat[0].save(stream_, "GIF", save_all=True, append_images=flat[1:], loop=0, optimize=False,
                 duration=[min(round(1000 * FRAME_S * n), 655_350) for n in lasting])  # fmt: skip
    return stream_.getvalue()


def _palette(frame: Image.Image) -> Image.Image:
    """Return a palette with the frame's shades and every colour that means something."""
    sample = frame.copy()
    size = max(sample.height // 16, 1)
    for i, colour in enumerate((*CONTROL.values(), SKY, VERMILLION, BLACK, "white")):
        sample.paste(colour, (0, i * 2 * size, 4 * size, (i + 1) * 2 * size))
    return sample.quantize(32, dither=Image.Dither.NONE)
