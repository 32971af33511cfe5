"""Other courses on the page."""

import pandas as pd

from analysis.figures.section_shares import KINDS
from analysis.report.blocks import Paragraph, Picture, Section, Shown, table
from analysis.report.numbers import count, number, percent, with_interval
from analysis.reproduction.generalisation.figure import generalisation_figure


def generalisation_section(laps: pd.DataFrame, shares: pd.DataFrame, taught_on: str) -> Section:
    """Return how models taught on one course fare on others.

    Parameters
    ----------
    laps, shares
        As ``course_table`` and ``section_table`` return them.
    taught_on
        The course that the models were taught on.
    """
    model = laps[laps["condition"] == "model"]
    differences = ", ".join(
        f"{r['course']} {number(r['over_limited_s'])} s" for r in model.to_dict("records")
    )
    return Section(
        "generalisation",
        "Generalisation to other courses",
        (
            Paragraph(
                "The paper did not test this. Each replicate drives other courses with its own "
                f"model, which three demonstrations on {taught_on} have taught and which learns "
                "nothing more. The mirror image has no right turn: the limitation "
                "should hardly matter there, and the model should not help. On "
                f"{taught_on} the laps with help are those of the same models."
            ),
            Picture(
                "generalisation",
                "Left: mean lap times by course and condition, with 95% interval. "
                "Right: share of steps in which the model helped by kind of section, with 95% "
                "interval; the line is where the demonstrator would have.",
                f"Model minus limited: {differences}.",
                generalisation_figure(laps, shares),
            ),
            table(
                "generalisation",
                "Lap times by course, s; an unfinished lap counts as the time it was given. 95% "
                "intervals. Differences replicate by replicate.",
                laps,
                _LAPS,
            ),
            table(
                "generalisation_sections",
                "Share of steps in which the model helped, by kind of section, with 95% interval "
                "over replicates, and in which the demonstrator would have.",
                shares,
                _SHARES,
            ),
        ),
    )


_LAPS = [
    Shown("course", lambda r: r["course"], words=True),
    Shown("condition", lambda r: r["condition"], words=True),
    Shown("n", lambda r: count(r["n"])),
    Shown("unfinished", lambda r: count(r["unfinished"])),
    Shown("mean", lambda r: with_interval(r["mean_s"], r["low_s"], r["high_s"])),
    Shown("sd", lambda r: number(r["sd_s"], 2)),
    Shown("median", lambda r: number(r["median_s"])),
    Shown("minus limited", lambda r: with_interval(
        r["over_limited_s"], r["over_limited_low"], r["over_limited_high"])),
    Shown("minus demonstrator", lambda r: with_interval(
        r["over_demonstrator_s"], r["over_demonstrator_low"], r["over_demonstrator_high"])),
]  # fmt: skip

_SHARES = [
    Shown("course", lambda r: r["course"], words=True),
    Shown("kind", lambda r: KINDS.get(r["kind"], r["kind"]), words=True),
    Shown("n", lambda r: count(r["n"])),
    Shown("model helped", lambda r: percent(100 * r["assisted"], 1)),
    Shown("95%", lambda r: f"{percent(100 * r['low'], 1)} to {percent(100 * r['high'], 1)}"),
    Shown("demonstrator would", lambda r: percent(100 * r["would"], 1)),
]
