"""The questionnaires."""

import math

import pandas as pd

from analysis.comparisons import PairedComparison
from analysis.figures.likert import likert_figure
from analysis.report.blocks import Block, Caution, Paragraph, Picture, Section, Shown, table
from analysis.report.numbers import NOTHING, count, interval, number, p_value, percent, rank_sum
from analysis.results import StudyResults, SurveyResults
from analysis.roles import Part, first
from analysis.tables.comparisons import comparison_table

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
    asked, missing, not_reached = (
        int(answers[name].sum()) for name in ("asked", "missing", "not_reached")
    )
    agreeing = f"{instrument.anchors[instrument.agreement_from - 1]!r} or above"
    blocks: list[Block] = [
        Paragraph(
            f"{instrument.title}: {len(instrument.items)} items on {instrument.points} points "
            f"({', '.join(instrument.anchors)}). Of {asked} answers (every planned "
            f"question, every analysed participant) {missing} are missing and {not_reached} were "
            "not reached (no row in the record: the participant had left, did not drive the lap, "
            "or was not asked). Every item uses all answers it has. "
            f"{instrument.source}"
        ),
        Picture(
            f"answers_{instrument.name}",
            "Answers by item and condition, centred on the scale's middle: disagreement to the "
            "left, agreement to the right.",
            f"Diverging bars of answers. {_said(survey)}",
            likert_figure(answers, instrument),
        ),
        table(f"answers_{instrument.name}", f"Answers by item and condition. Agreement: {agreeing},"
              " in percent of those who answered.", answers, _ANSWERS, folded=True),
    ]  # fmt: skip
    helpers = _between_helpers(results.frames.parts, survey.comparisons)
    if helpers:
        blocks.append(
            table(f"items_{instrument.name}", f"Exploratory: {helpers[0].condition} (condition) "
                  f"against {helpers[0].reference} (reference), item by item. "
                  "Wilcoxon signed-rank, mid-ranks, zeros after Pratt; p not corrected. "
                  "Odds of a higher answer: ordinal regression.",
                  _with_agreement(helpers, answers), [_TESTS[0], *_AGREEMENT, *_TESTS[3:]])
        )  # fmt: skip
    others = [c for c in survey.comparisons if c not in helpers]
    if others:
        blocks.append(
            table(f"items_{instrument.name}_others", "Exploratory: items between the other "
                  "conditions after which they were asked; p not corrected.",
                  comparison_table(others), _TESTS, folded=True)
        )  # fmt: skip
    blocks.append(
        table(f"scales_{instrument.name}", "Composite scores: mean of a subscale's items, "
              "reverse-coded items turned, over complete answer sheets; Cronbach's alpha with "
              "Feldt's interval.", survey.scales, _SCALES, folded=True)
    )  # fmt: skip
    return blocks


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
    answered = survey.table[survey.table["answered"] > 0]
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
    Shown("rank-biserial", lambda r: number(r["rank_biserial"], 2)),
    Shown("95%", lambda r: interval(r["rank_biserial_low"], r["rank_biserial_high"], 2)),
    Shown("odds ratio", lambda r: number(r["odds_ratio"], 2)),
    Shown("95%", lambda r: _odds(r["odds_ratio_low"], r["odds_ratio_high"])),
    Shown("remarks", lambda r: r["notes"] or NOTHING, words=True),
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
