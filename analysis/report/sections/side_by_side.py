"""Living and synthetic people beside each other."""

from collections.abc import Sequence

import pandas as pd

from analysis.figures.side_by_side import answers_figure, time_points, times_figure
from analysis.report.blocks import Block, Caution, Paragraph, Picture, Section, Shown, table
from analysis.report.lap_links import lap_spots
from analysis.report.numbers import count, number, percent
from analysis.results import StudyResults
from analysis.side_by_side import SideBySide


def side_section(results: StudyResults) -> Section | None:
    """Return lap times and answers by kind of people; None where there is one kind only."""
    found = results.people
    if found is None:
        return None
    conditions = list(dict.fromkeys(found.times["condition"]))
    blocks: list[Block] = [Paragraph(_about(found))]
    if not found.same_course:
        blocks.append(Caution("The two studies drove different courses: their lap times differ by "
                              "that, too."))  # fmt: skip
    blocks += [
        Picture(
            "side_by_side",
            "Lap times by condition and kind of people.",
            f"Lap times side by side. {_in_words(found)}",
            times_figure(found.laps, conditions, found.groups),
            lap_spots(results, _points(found, conditions)),
        ),
        table("side_by_side", "Lap times of finished laps, s.", found.times, _TIMES),
    ]
    if len(found.answers):
        blocks += [
            Picture(
                "answers_side_by_side",
                "Percent who agree with each item after each condition.",
                f"Agreement side by side. {_agreement(found)}",
                answers_figure(found.answers, found.groups),
            ),
            table("answers_side_by_side", "Agreement by item, condition and kind of people.",
                  found.answers, _ANSWERS, folded=True),
        ]  # fmt: skip
    return Section("side-by-side", "Living and synthetic people side by side", tuple(blocks))


def _about(found: SideBySide) -> str:
    where = "" if found.other is None else f" The others are of the study {found.other}."
    return (
        f"Shown: {', '.join(found.groups)}.{where} How synthetic people drive and answer was "
        "assumed, not observed: where they differ from living ones, the assumptions are wrong. No "
        "test is made."
    )


def _points(found: SideBySide, conditions: Sequence[str]) -> pd.DataFrame:
    """Return where the points of this study's own laps are in the figure; see ``lap_spots``."""
    points = time_points(found.laps, conditions, found.groups)
    points = points[points["here"]]
    return points.assign(value=[f"{number(time)} s" for time in points["y"]])


def _in_words(found: SideBySide) -> str:
    said = (
        f"{row['condition']}, {row['people']}: mean {number(row['mean'])} s, n = {row['n']}"
        for row in found.times.to_dict("records")
    )
    return "; ".join(said) + "."


def _agreement(found: SideBySide) -> str:
    said = (
        f"{row['item']} {row['condition']} {row['people']} {percent(row['agree_percent'])}"
        for row in found.answers.to_dict("records")
    )
    return "; ".join(said) + "."


_TIMES = [
    Shown("condition", lambda r: r["condition"], words=True),
    Shown("people", lambda r: r["people"], words=True),
    Shown("laps", lambda r: count(r["laps"])),
    Shown("unfinished", lambda r: count(r["unfinished"])),
    Shown("n", lambda r: count(r["n"])),
    Shown("mean", lambda r: number(r["mean"])),
    Shown("sd", lambda r: number(r["sd"], 2)),
    Shown("median", lambda r: number(r["median"])),
]
_ANSWERS = [
    Shown("item", lambda r: f"{r['instrument']}.{r['item']}", words=True),
    Shown("text", lambda r: r["text"], words=True),
    Shown("condition", lambda r: r["condition"], words=True),
    Shown("people", lambda r: r["people"], words=True),
    Shown("answered", lambda r: count(r["answered"])),
    Shown("agree", lambda r: percent(r["agree_percent"])),
]
