"""The questionnaires."""

import math

import pandas as pd

from analysis.comparisons import PairedComparison
from analysis.figures.likert import likert_figure
from analysis.report.blocks import Block, Caution, Paragraph, Picture, Section, Shown, table
from analysis.report.numbers import (
    NOTHING,
    count,
    interval,
    number,
    p_value,
    percent,
    plural,
    rank_sum,
)
from analysis.results import StudyResults, SurveyResults
from analysis.roles import Part, first
from analysis.tables.comparisons import comparison_table
from analysis.tables.scales import RELIABLE
from protocols.instrument import Instrument

ASSUMED = (
    "Answers of synthetic participants are drawn from a model with assumed loadings. Agreement "
    "percentages are consequences of these assumptions, not findings."
)


def survey_section(results: StudyResults) -> Section:
    """Return answers and tests of every instrument."""
    if not results.surveys:
        nothing = Paragraph("Nothing was asked in this study.")
        return Section("questionnaire", "Questionnaire", (nothing,))
    blocks: list[Block] = []
    if results.frames.synthetic:
        blocks.append(Caution(ASSUMED))
    for survey in results.surveys:
        blocks += _instrument(results, survey)
    return Section("questionnaire", "Questionnaire", tuple(blocks))


def _instrument(results: StudyResults, survey: SurveyResults) -> list[Block]:
    instrument, answers = survey.instrument, survey.table
    name, tests = instrument.name, survey.comparisons
    blocks: list[Block] = [Paragraph(_about(survey)), *_declared(results, instrument)]
    blocks.append(table(f"scales_{name}", _ABOUT_SCALES, survey.scales, _SCALES))
    if instrument.points:
        blocks.append(_picture(survey))
    blocks.append(table(f"answers_{name}", _about_answers(instrument), answers, _ANSWERS,
                        folded=True))  # fmt: skip
    helpers = _between_helpers(results.frames.parts, tests)
    if helpers:
        caption = (
            f"Exploratory: {helpers[0].condition} (condition) against {helpers[0].reference} "
            f"(reference), item by item. {_ABOUT_ITEMS}"
        )
        columns = [_TESTS[0], *_AGREEMENT, *_TESTS[3:]]
        blocks.append(table(f"items_{name}", caption, _with_agreement(helpers, answers), columns))
    others = [c for c in tests if c not in helpers]
    if others:
        caption = (
            "Exploratory: items between the other conditions after which they were asked. "
            f"{_ABOUT_ITEMS}"
        )
        frame = comparison_table(others)
        blocks.append(table(f"items_{name}_others", caption, frame, _TESTS, folded=True))
    return blocks


_ABOUT_SCALES = (
    "Composite scores over complete answer sheets: mean of a subscale's items, reverse-coded items "
    "turned, on the instrument's scale of scores; Cronbach's alpha with Feldt's interval. A score "
    f"whose alpha is below {RELIABLE:g} is not interpreted: its items do not measure one thing."
)
_ABOUT_ITEMS = (
    "Wilcoxon signed-rank, mid-ranks, zeros after Pratt; p also after Holm over all comparisons of "
    "this instrument's items. Odds of a higher answer: ordinal regression, marginal over people."
)


def _about(survey: SurveyResults) -> str:
    instrument, answers = survey.instrument, survey.table
    asked, missing, not_reached = (
        int(answers[name].sum()) for name in ("asked", "missing", "not_reached")
    )
    points = (
        f" on {instrument.points} points ({', '.join(instrument.anchors)})"
        if instrument.points
        else ""
    )
    return (
        f"{instrument.title}: {plural(len(instrument.items), 'item')}{points}. Of {asked} answers "
        f"(every planned question, every analysed participant) {missing} are missing and "
        f"{not_reached} were not reached (no row in the record: the participant had left, did not "
        f"drive the lap, or was not asked). Every item uses all answers it has. {instrument.source}"
    )


def _about_answers(instrument: Instrument) -> str:
    if not instrument.points:
        return "Answers by item and condition."
    agreeing = f"{instrument.anchors[instrument.agreement_from - 1]!r} or above"
    return (
        f"Answers by item and condition. Agreement: {agreeing}, in percent of those who answered."
    )


def _picture(survey: SurveyResults) -> Picture:
    return Picture(
        f"answers_{survey.instrument.name}",
        "Answers by item and condition, centred on the scale's middle: disagreement to the left, "
        "agreement to the right.",
        f"Diverging bars of answers. {_said(survey)}",
        likert_figure(survey.table, survey.instrument),
    )


def _declared(results: StudyResults, instrument: Instrument) -> list[Block]:
    """Return what the protocol declares about this instrument: it comes first."""
    found = [c for c in results.declared if c.outcome.rpartition(".")[0] == instrument.name]
    if not found:
        return []
    frame = comparison_table(found)
    caption = "Declared by the protocol. Wilcoxon signed-rank; p after Holm where confirmatory."
    return [table(f"declared_{instrument.name}", caption, frame, _DECLARED)]


def _between_helpers(
    parts: tuple[Part, ...], comparisons: tuple[PairedComparison, ...]
) -> list[PairedComparison]:
    """Return the paper's comparison: the model against the demonstrator."""
    pair = {first(parts, "demonstrator"), first(parts, "model")}
    return [c for c in comparisons if {c.condition, c.reference} == pair]


def _with_agreement(comparisons: list[PairedComparison], answers: pd.DataFrame) -> pd.DataFrame:
    """Return the tests with the agreement in both conditions, in percent."""
    agreeing = answers.set_index(["item", "condition"])["agree_percent"]
    frame = comparison_table(comparisons)
    items = [str(outcome).rpartition(".")[2] for outcome in frame["outcome"]]
    for side in ("condition", "reference"):
        pairs = zip(items, frame[side], strict=True)
        frame[f"agree_percent_{side}"] = [float(agreeing[pair]) for pair in pairs]
    return frame


def _said(survey: SurveyResults) -> str:
    answered = survey.table[survey.table["agree_percent"].notna()]
    said = (
        f"{row['item']} {row['condition']} {percent(row['agree_percent'])} agree"
        for row in answered.to_dict("records")
    )
    return "; ".join(said) or "Nothing was answered."


def _odds(low: float, high: float) -> str:
    """Return an interval of which an end may be 0 or without bound."""
    if math.isnan(low) or math.isnan(high):
        return NOTHING
    return f"{number(low, 2)} to {'∞' if math.isinf(high) else number(high, 2)}"


_ANSWERS = [
    Shown("item", lambda r: r["item"], words=True),
    Shown("text", lambda r: r["text"], words=True),
    Shown("condition", lambda r: r["condition"], words=True),
    Shown("asked", lambda r: count(r["asked"])),
    Shown("answered", lambda r: count(r["answered"])),
    Shown("missing", lambda r: count(r["missing"])),
    Shown("not reached", lambda r: count(r["not_reached"])),
    Shown("median", lambda r: number(r["median"])),
    Shown("agree", lambda r: percent(r["agree_percent"])),
]
_AGREEMENT = [
    Shown("agree: reference", lambda r: percent(r["agree_percent_reference"])),
    Shown("agree: condition", lambda r: percent(r["agree_percent_condition"])),
]
_TESTS = [
    Shown("item", lambda r: r["outcome"].rpartition(".")[2], words=True),
    Shown("condition", lambda r: r["condition"], words=True),
    Shown("reference", lambda r: r["reference"], words=True),
    Shown("pairs", lambda r: count(r["n_pairs"])),
    Shown("missing", lambda r: count(r["n_missing"])),
    Shown("T+", lambda r: rank_sum(r["wilcoxon_statistic"])),
    Shown("p", lambda r: p_value(r["wilcoxon_p"])),
    Shown("p (Holm)", lambda r: p_value(r["p_items"])),
    Shown("rank-biserial", lambda r: number(r["rank_biserial"], 2)),
    Shown("95%", lambda r: interval(r["rank_biserial_low"], r["rank_biserial_high"], 2)),
    Shown("odds ratio", lambda r: number(r["odds_ratio"], 2)),
    Shown("95%", lambda r: _odds(r["odds_ratio_low"], r["odds_ratio_high"])),
    Shown("remarks", lambda r: r["notes"] or NOTHING, words=True),
]
_DECLARED = [
    Shown("name", lambda r: r["name"], words=True),
    Shown("outcome", lambda r: r["outcome"].rpartition(".")[2], words=True),
    *_TESTS[1:6],
    Shown("p", lambda r: p_value(r["p"])),
    Shown("p (Holm)", lambda r: p_value(r["p_holm"])),
    Shown("rank-biserial", lambda r: number(r["rank_biserial"], 2)),
    Shown("95%", lambda r: interval(r["rank_biserial_low"], r["rank_biserial_high"], 2)),
]
_SCALES = [
    Shown("subscale", lambda r: r["subscale"], words=True),
    Shown("condition", lambda r: r["condition"], words=True),
    Shown("items", lambda r: count(r["items"])),
    Shown("n", lambda r: count(r["n"])),
    Shown("incomplete", lambda r: count(r["incomplete"])),
    Shown("mean", lambda r: number(r["mean"], 2)),
    Shown("sd", lambda r: number(r["sd"], 2)),
    Shown("alpha", lambda r: number(r["alpha"], 2)),
    Shown("95%", lambda r: interval(r["alpha_low"], r["alpha_high"], 2)),
    Shown("remarks", lambda r: r["note"] or NOTHING, words=True),
]
