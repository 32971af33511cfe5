"""Recorded laps as a moving picture or a page, without another simulation."""

import math
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import groupby, zip_longest
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
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
from analysis.film import Encoder, gif, mp4, require_encoder
from analysis.frames import as_frame
from analysis.lap_pages.lap_data import LapOf, lap_data, lap_of
from analysis.lap_pages.page import render_laps
from analysis.measures.streams import Numbers, Steps, stream, words
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
    laps: Sequence[tuple[str, int]],
    out: Path,
    progress: Callable[[str], None] | None = None,
) -> None:
    """Draw a lap, or two side by side: a moving picture, or a page to move through.

    A GIF or an MP4 shows the plan with chair, laser and trail, and p(h) against time; a page shows
    the first-person view, the sticks and every value, too.

    Parameters
    ----------
    study_dir
        The study directory.
    laps
        One or two: the participant's id, and the lap, counted from 0.
    out
        The file to write; replaced when it exists, never left half-written. Its ending says what
        it is: .gif, .mp4 or .html.
    progress
        Called with a few words about what is being done.

    Raises
    ------
    InputError
        When there is no such study, participant or lap, its steps are damaged, the file's name has
        another ending, there is no package that encodes an MP4, or it cannot be written.

    Examples
    --------
    >>> write_replay(Path("nowhere"), [("P0001", 3)], Path("lap.html"))
    Traceback (most recent call last):
    protocols.files.errors.InputError: nowhere: no such folder
    """
    out = Path(out)
    encode = _encoder(out)
    if not out.parent.is_dir():
        raise InputError(f"{out}: cannot be written: {out.parent}: no such folder")
    study = open_study(Path(study_dir))
    found = [_found(study, participant, lap) for participant, lap in laps]
    tell = progress or (lambda _: None)
    content = _page(study, found) if encode is None else encode(*_film(study, found, tell))
    try:
        write_whole(out, content)
    except OSError as error:
        raise InputError(f"{out}: cannot be written: {error.strerror}") from None


@dataclass(frozen=True, slots=True)
class _Found:
    """A lap and its steps; ``shown`` has the steps to be shown, and for how many frames."""

    of: LapOf
    steps: Steps
    shown: dict[int, int]
    on_course: bool


def _encoder(out: Path) -> Encoder | None:
    """Return what makes a film of frames; None for a page."""
    ending = out.suffix.lower()
    if ending == ".html":
        return None
    if ending == ".gif":
        return partial(gif, colours=(*CONTROL.values(), SKY, VERMILLION, BLACK, "white"))
    if ending == ".mp4":
        require_encoder(out)
        return mp4
    raise InputError(
        f"{out}: is not the name of a replay; allowed: a name that ends with .gif, .mp4 or .html"
    )


def _found(study: Study, participant: str, lap: int) -> _Found:
    table, _, placement = study.lap_steps(participant, lap, against_lap=False)
    steps = Steps(table)
    where = f"{study.folder}: {participant}, lap {lap}"
    if len(steps) < 2:
        raise InputError(f"{where}: too short to draw; needs 2 steps")
    shown = shown_steps(stream(steps, "t_s"))
    if shown is None:
        raise InputError(f"{where}: its steps have no times that go on; a replay needs them")
    return _Found(_lap_of(study, participant, lap), steps, shown, placement.on_course)


def _lap_of(study: Study, participant: str, lap: int) -> LapOf:
    """Return a lap as it was recorded; its condition is ? when the lap has no row."""
    laps = study.laps
    rows = laps.filter(
        pc.and_(pc.equal(laps["participant"], participant), pc.equal(laps["lap"], lap))
    )
    if not len(rows):
        return LapOf(participant, lap, "?", completed=False, time_s=math.nan)
    return lap_of(as_frame(rows).to_dict("records")[0])


def _page(study: Study, found: Sequence[_Found]) -> bytes:
    title = f"{study.protocol.title}: " + " and ".join(
        f"{one.of.participant}, lap {one.of.lap}" for one in found
    )
    held = [lap_data(one.of, one.steps, study.course_of(one.of.participant)) for one in found]
    return render_laps(title, study.courses, held, [lap["key"] for lap in held]).encode()


def _film(
    study: Study, found: Sequence[_Found], tell: Callable[[str], None]
) -> tuple[list[Image.Image], list[int], float]:
    """Return the frames, for how many times ``FRAME_S`` each is shown, and ``FRAME_S``."""
    with literal_text():
        stages = [
            _Stage(study.course_of(one.of.participant), one.steps, _title(one)) for one in found
        ]
        times = list(together([one.shown for one in found]))
        frames = []
        for done, (at, _) in enumerate(times):
            if done % 25 == 0:
                tell(f"Drawing frames: {done} of {len(times)}")
            drawn = [stage.frame(i) for stage, i in zip(stages, at, strict=True)]
            frames.append(_side_by_side(drawn))
    return frames, [lasting for _, lasting in times], FRAME_S


def _title(one: _Found) -> str:
    title = wrapped(f"{one.of.participant}, lap {one.of.lap}: {one.of.condition}", 60, lines=4)
    return title if one.on_course else f"{title}\n(its positions do not fit the course)"


def together(shown: Sequence[dict[int, int]]) -> Iterator[tuple[tuple[int, ...], int]]:
    """Yield which step of each lap is shown at the same time, and for how many frames.

    Parameters
    ----------
    shown
        Of each lap, as ``shown_steps`` returns it; a lap that has ended stands at its last step.

    Examples
    --------
    >>> list(together([{0: 1, 2: 2}, {0: 3, 5: 1}]))
    [((0, 0), 1), ((2, 0), 2), ((2, 5), 1)]
    """
    frames = [[i for i, n in one.items() for _ in range(n)] for one in shown]
    at = zip_longest(*frames)
    last = tuple(one[0] for one in frames)
    pairs = []
    for steps in at:
        last = tuple(before if i is None else i for i, before in zip(steps, last, strict=True))
        pairs.append(last)
    for pair, run in groupby(pairs):
        yield pair, len(list(run))


def _side_by_side(frames: Sequence[Image.Image]) -> Image.Image:
    if len(frames) == 1:
        return frames[0]
    width, height = sum(frame.width for frame in frames), max(frame.height for frame in frames)
    whole = Image.new("RGB", (width, height), "white")
    at = 0
    for frame in frames:
        whole.paste(frame, (at, 0))
        at += frame.width
    return whole


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
        self._colours = [CONTROL.get(c, BLACK) for c in words(steps, "control")][1:]
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


def _legend(axes: Axes, steps: Steps) -> None:
    given = set(words(steps, "control"))
    there = [name for name in CONTROL if name in given]
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
