"""The mixed model of lap times, and how much practice could explain."""

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import pandas as pd

from analysis.frames import StudyFrames
from analysis.practice import other_orders
from analysis.report.blocks import Block, Paragraph, Remarks, Section, Shown, table
from analysis.report.numbers import count, interval, number, p_value, percent, with_interval
from analysis.results import StudyResults
from analysis.roles import reference_condition
from analysis.stats.result import TestResult


def practice_section(results: StudyResults) -> Section:
    """Return the model's contrasts, and what is left of them under plausible practice."""
    blocks: list[Block] = []
    if results.model:
        frame = _contrasts(results.model, results.contrasts)
        blocks.append(table("mixed_model", _caption(results.model), frame, _MODEL))
        blocks.append(Remarks((*_about(results.model), *_about_own(results.contrasts))))
    else:
        blocks.append(Paragraph(f"There is no mixed model: {_why_no_model(results)}."))
    if results.carry_over:
        frame = _contrasts(results.carry_over, ())
        blocks.append(table("carry_over", _ABOUT_CARRY_OVER, frame, _MODEL[:6]))
    if not results.practice.empty:
        blocks += _practice(results.frames, results.practice)
    return Section("practice", "Mixed model and practice", tuple(blocks))


_ABOUT_CARRY_OVER = (
    "Exploratory: carry-over, the ratio of lap times after one condition / after another, beside "
    "condition and place in the mixed model. A ratio away from 1 says that the lap before changes "
    "the next one, and that comparisons of conditions carry some of it."
)


def _caption(model: Sequence[TestResult]) -> str:
    ratios = (
        "Ratios of (geometric mean) lap times, condition / reference: below 1 the condition is "
        "faster."
    )
    if not any(found.checks for found in model):
        return f"Exploratory: log lap times without a mixed model, for the reason below. {ratios}"
    return (
        f"Exploratory: {_formula(model)}. {ratios} The model takes all "
        "contrasts to spread alike; the last three columns, from each participant's own contrast, "
        "do not, and are the ones to read where the standard deviations differ."
    )


def _formula(model: Sequence[TestResult]) -> str:
    """Return the model in words, as its method has it: with the place, where it is identified."""
    start = next(found.method for found in model if found.method).partition(", REML")[0]
    return start.removeprefix("linear mixed model, ")


def _why_no_model(results: StudyResults) -> str:
    reference = reference_condition(results.frames.parts)
    if reference is None:
        return "the study has no condition without help that the others could be set against"
    timed = set(results.frames.laps.dropna(subset=["lap_time_s"])["condition"])
    if reference not in timed:
        return f"no lap of {reference}, which the others are set against, has a time"
    return f"no lap of another condition than {reference} has a time"


def _contrasts(model: Sequence[TestResult], own: Sequence[TestResult]) -> pd.DataFrame:
    by_name = {found.name: found for found in own}
    return pd.DataFrame(
        [
            {
                "contrast": found.name,
                "n": found.n,
                "log_ratio": found.estimate,
                "ratio": math.exp(found.estimate),
                "ratio_low": math.exp(found.low),
                "ratio_high": math.exp(found.high),
                "t": found.statistic,
                "p": found.p,
                **_own(by_name.get(found.name)),
                "method": found.method,
                "notes": "; ".join([*found.checks, *found.notes, found.why_not or ""]).strip("; "),
            }
            for found in model
        ]
    )


def _own(found: TestResult | None) -> dict[str, float]:
    own = TestResult.missing("", 0, "no pair") if found is None else found
    low, high = math.exp(own.low), math.exp(own.high)
    return {"own_n": own.n, "own_ratio_low": low, "own_ratio_high": high, "own_p": own.p}


def _about(model: Sequence[TestResult]) -> tuple[str, ...]:
    """Return what was used and what was checked, each once."""
    said = [found.method for found in model if found.method]
    said += [check for found in model for check in found.checks]
    said += [note for found in model for note in found.notes]
    said += [f"{found.name}: {found.why_not}" for found in model if found.why_not]
    return tuple(f"{text[0].upper()}{text[1:].rstrip('.')}." for text in dict.fromkeys(said))


def _about_own(contrasts: Sequence[TestResult]) -> tuple[str, ...]:
    """Return one remark for each participant's-own contrast."""
    said = ((f.name, [f.method, *f.checks, *f.notes, f.why_not]) for f in contrasts)
    return tuple(
        f"{name}, own spread: {'; '.join(text for text in texts if text)}." for name, texts in said
    )


def _confounded(frames: StudyFrames) -> str:
    others, people = other_orders(frames)
    if others:
        return (
            f"Only {others} of {people} participants drove another order than the rest: with the "
            "lap's place in the model, practice would depend on these few. So practice and "
            "condition are confounded."
        )
    return (
        "The place of a lap in the session follows from its condition: the model matrix with both "
        "would be singular, so practice and condition are confounded."
    )


def _practice(frames: StudyFrames, frame: pd.DataFrame) -> list[Block]:
    tipping = frame.drop_duplicates(["condition", "reference"]).to_dict("records")
    return [
        Paragraph(
            f"{_confounded(frames)} Instead, the table shows what is left of each ratio if "
            "practice had saved a given share of the time from every lap to the next."
        ),
        replace(
            table("practice", "Ratio of lap times left, with 95% intervals, if practice had saved "
                  "this share of the time per lap.", _side_by_side(frame), _columns(frame)),
            frame=frame,
        ),
        Remarks(tuple(_tipping({str(k): v for k, v in row.items()}) for row in tipping)),
    ]  # fmt: skip


def _side_by_side(frame: pd.DataFrame) -> pd.DataFrame:
    """Return one row per contrast, with a cell of text per assumed practice."""
    rows: dict[tuple[str, str], dict[str, str]] = {}
    for r in frame.to_dict("records"):
        pair = r["condition"], r["reference"]
        row = rows.setdefault(pair, {"pair": " against ".join(pair)})
        left = with_interval(r["ratio"], r["ratio_low"], r["ratio_high"], 2)
        row[_share(r["practice_percent"])] = left
    return pd.DataFrame(list(rows.values()))


def _columns(frame: pd.DataFrame) -> list[Shown]:
    def cell(share: str) -> Shown:
        return Shown(share, lambda r: r[share])

    shares = dict.fromkeys(_share(p) for p in frame["practice_percent"])
    return [Shown("contrast", lambda r: r["pair"], words=True), *(cell(s) for s in shares)]


def _share(practice: float) -> str:
    return f"{practice:g}%"


def _tipping(row: dict[str, Any]) -> str:
    pair, at = f"{row['condition']} against {row['reference']}", row["explains_percent"]
    if math.isnan(at):
        return f"{pair}: practice would work in the other direction; it cannot explain this."
    if at == 0:
        return f"{pair}: no difference is shown that practice would have to explain."
    all_of_it = row["explains_all_percent"]
    return (
        f"{pair}: practice would have to save {percent(at, 1)} per lap to bring 1 into the "
        f"interval, and {percent(all_of_it, 1)} to explain the whole estimate."
    )


_MODEL = [
    Shown("contrast", lambda r: r["contrast"], words=True),
    Shown("participants", lambda r: count(r["n"])),
    Shown("ratio", lambda r: number(r["ratio"], 3)),
    Shown("95%", lambda r: interval(r["ratio_low"], r["ratio_high"], 3)),
    Shown("t", lambda r: number(r["t"], 2)),
    Shown("p", lambda r: p_value(r["p"])),
    Shown("pairs", lambda r: count(r["own_n"])),
    Shown("95%, own spread", lambda r: interval(r["own_ratio_low"], r["own_ratio_high"], 3)),
    Shown("p, own spread", lambda r: p_value(r["own_p"])),
]
