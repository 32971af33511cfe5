"""Why the numbers differ: what each declared explanation does to them."""

import math
from pathlib import Path

import numpy as np
import pandas as pd

from analysis.measures.discrimination import when_auc
from analysis.measures.episodes import episodes
from analysis.measures.streams import Steps, period, stream
from analysis.report.blocks import Paragraph, Section, Shown, table
from analysis.report.numbers import count, number
from analysis.reproduction.anticipation import RISEN
from analysis.reproduction.lessons import STUDIES
from analysis.stats.mean_difference import mean_difference
from protocols.explanations import EXPLANATIONS, Explanation
from protocols.record.reader import Study, open_study

WHY = "why"
FIRST, ONE, THREE = "demonstrator", "model after 1", "model after 3"
FURTHER = "further demonstration"
HUMAN, MODEL = "human-assisted", "model-assisted"


def why_table(folder: Path) -> pd.DataFrame:
    """Return a row for each explanation.

    Parameters
    ----------
    folder
        The reproduction's, its studies of explanations run.

    Returns
    -------
    DataFrame
        ``name``, ``supposition``, ``study``, ``n``; mean laps in s ``demonstrator``, ``after_1``
        and ``after_3`` (of people: ``after_1`` is the lap with the model), an unfinished one as
        long as it took; ``behind_s``, the lap after one demonstration minus the demonstrator's,
        in pairs, with its 95% interval ``low`` to ``high``; ``takeovers`` in that lap; ``auc``,
        the median over laps of the demonstration after the first; ``anticipated``, the share of
        its takeovers before which p(h) had risen to .25.

    Raises
    ------
    InputError
        When a study is missing or cannot be used.
    """
    rows = [
        _row(explanation, open_study(folder / STUDIES / WHY / explanation.name))
        for explanation in EXPLANATIONS
    ]
    return pd.DataFrame(rows)


def _row(explanation: Explanation, study: Study) -> dict[str, object]:
    laps = study.laps.to_pandas()
    rd = explanation.study == "rd-laps"
    shown, helped = (FIRST, ONE) if rd else (HUMAN, MODEL)
    wide = laps.pivot_table(
        index="participant", columns="condition", values="duration_s", aggfunc="first"
    )
    takeovers = laps.loc[laps["condition"] == helped, "interventions"].mean()
    behind = mean_difference((wide[helped] - wide[shown]).dropna().tolist())
    return {
        "name": explanation.name,
        "supposition": explanation.supposition,
        "study": explanation.study,
        "n": behind.n,
        "demonstrator": float(wide[shown].mean()),
        "after_1": float(wide[helped].mean()),
        "after_3": float(wide[THREE].mean()) if rd else math.nan,
        "behind_s": behind.estimate,
        "low": behind.low,
        "high": behind.high,
        "takeovers": float(takeovers),
        **(_foreseen(study, laps) if rd else {"auc": math.nan, "anticipated": math.nan}),
    }


def _foreseen(study: Study, laps: pd.DataFrame) -> dict[str, float]:
    """Return AUC and anticipation in the first demonstration after one was learnt."""
    second = laps[laps["condition"] == FURTHER].groupby("participant", sort=False)["lap"].min()
    aucs, risen = [], []
    for participant, lap in second.items():
        steps = Steps(study.steps(str(participant), int(lap)))
        aucs.append(when_auc(steps))
        p = stream(steps, "p_help")
        before = max(1, round(0.1 / period(steps)))
        starts = [start for start, _ in episodes(stream(steps, "h") > 0) if start >= before]
        risen += [bool(p[start - before] >= RISEN) for start in starts]
    known = [auc for auc in aucs if not math.isnan(auc)]
    return {
        "auc": float(np.median(known)) if known else math.nan,
        "anticipated": float(np.mean(risen)) if risen else math.nan,
    }


def why_section(rows: pd.DataFrame) -> Section:
    """Return the section of the page."""
    return Section(
        "why",
        "Why the numbers differ",
        (
            Paragraph(
                "Each supposition is a change to a shipped study, run with the same random "
                "numbers. A change that brings a number to the paper's is sufficient for it in "
                "this simulator; it is no evidence of what was done in 2013. The paper has 40.5, "
                "42.6 and 40.4 s with the demonstrator and after one and three demonstrations, an "
                "AUC of .95 after the first, and people 11.5 s slower with the model."
            ),
            table(
                "why",
                "One row for each declared explanation; laps in s, an unfinished one as long as "
                "it took; 95% interval of the difference in pairs. Anticipated: p(h) had risen to "
                ".25 a tenth of a second before the takeover.",
                rows,
                _COLUMNS,
            ),
        ),
    )


_COLUMNS = [
    Shown("supposition", lambda r: r["supposition"], words=True),
    Shown("study", lambda r: r["study"], words=True),
    Shown("n", lambda r: count(r["n"])),
    Shown("demonstrator", lambda r: number(r["demonstrator"])),
    Shown("after 1", lambda r: number(r["after_1"])),
    Shown("after 3", lambda r: number(r["after_3"])),
    Shown("behind", lambda r: number(r["behind_s"])),
    Shown("95%", lambda r: f"{number(r['low'])} to {number(r['high'])}"),
    Shown("takeovers", lambda r: number(r["takeovers"])),
    Shown("AUC", lambda r: number(r["auc"], 4)),
    Shown("anticipated", lambda r: number(r["anticipated"], 2)),
]
