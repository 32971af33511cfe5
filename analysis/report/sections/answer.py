"""The first answers of the report: did assistance help, how much, how sure."""

import math

from analysis.comparisons import PairedComparison
from analysis.figures.effects import effect_figure
from analysis.frames import StudyFrames
from analysis.outcomes import by_participant
from analysis.practice import order_confounded, other_orders
from analysis.report.blocks import Block, Caution, Fact, Facts, Paragraph, Picture, Section
from analysis.report.numbers import count, interval, is_p, number, percent, plural
from analysis.results import StudyResults
from analysis.roles import reference_condition
from analysis.stats.result import TestResult

ALPHA = 0.05


def answer_section(results: StudyResults) -> Section:
    """Return the answers, each with its size and its certainty."""
    chosen = _chosen(results)
    blocks: list[Block] = []
    if chosen:
        blocks.append(Facts(tuple(_fact(results, c) for c in chosen)))
        blocks += [Paragraph(_sentence(c)) for c in chosen]
    else:
        blocks.append(Paragraph(_nothing_to_say(results)))
    blocks += [Caution(u.sentence) for u in results.unfinished]
    blocks += [Caution(text) for text in _cautions(results)]
    if chosen:
        blocks.append(_picture(chosen))
    return Section("answer", "Did assistance help?", tuple(blocks))


def _chosen(results: StudyResults) -> tuple[PairedComparison, ...]:
    """Return the declared comparisons of lap times; undeclared ones with help when none is."""
    helped = {p.condition for p in results.frames.parts if p.role in ("demonstrator", "model")}
    declared = [c for c in results.declared if c.outcome == "lap_time_s"]
    if declared:  # what helped comes first, in the protocol's order otherwise
        return tuple(sorted(declared, key=lambda c: c.condition not in helped))
    reference = reference_condition(results.frames.parts)
    return tuple(c for c in results.lap_times if c.condition in helped and c.reference == reference)


def _nothing_to_say(results: StudyResults) -> str:
    if any(part.role in ("demonstrator", "model") for part in results.frames.parts):
        return "The study has no condition without help to compare the assisted laps with."
    return "No condition of this study has an assistant, and it declares no comparison."


def _fact(results: StudyResults, c: PairedComparison) -> Fact:
    question = f"{c.condition} against {c.reference}"
    if c.difference is None or not c.difference.computed:
        return Fact(question, "cannot be said", f"{_why_not(c)}.")
    gain = -c.difference.estimate
    direction = "faster" if gain > 0 else "slower"
    answer = f"{number(abs(gain))} s {direction}" if gain else "no difference"
    wide = by_participant(results.frames, "lap_time_s")
    faster = int((wide[c.condition] < wide[c.reference]).sum())
    detail = f"{faster} of {plural(c.complete, 'participant')} faster; {_p(c)}"
    return Fact(question, answer, detail)


def _sentence(c: PairedComparison) -> str:
    kind = c.kind if c.declared else "not declared"
    start = f"{c.name[0].upper()}{c.name[1:]} ({kind}): "
    if c.difference is None or not c.difference.computed:
        return f"{start}cannot be computed: {_why_not(c)}."
    ratio = c.ratio_of_means
    speedup = "" if ratio is None else f" (a ratio of {percent(100 * ratio.estimate)})"
    text = (
        f"{start}{c.reference} {number(c.mean_reference)} s, {c.condition} "
        f"{number(c.mean_condition)} s{speedup}; mean difference "
        f"{number(c.difference.estimate)} s, {_certainty(c.difference)}; n = {count(c.complete)}"
        f"{_missing(c)}; {_p(c)}. {_verdict(c)}"
    )
    if c.equivalence is not None and c.equivalence.computed:
        text += _equivalence(c, c.equivalence)
    return text


def _certainty(difference: TestResult) -> str:
    if math.isfinite(difference.low):
        return f"95% interval {interval(difference.low, difference.high)} s"
    return "; ".join(difference.notes) or "no interval"


def _equivalence(c: PairedComparison, found: TestResult) -> str:
    corrected = math.isfinite(c.p_holm)
    p = c.p_holm if corrected else found.p
    return (
        f" Equivalence within the declared margin of ±{c.margin:g} {c.unit} is "
        f"{'shown' if p < ALPHA else 'not shown'} (TOST {is_p(p)}, "
        f"{'after Holm' if corrected else 'not corrected'}; 90% interval "
        f"{interval(found.low, found.high)} {c.unit})."
    )


def _verdict(c: PairedComparison) -> str:
    p = c.p_holm if _corrected(c) else c.signed_rank.p
    if not math.isfinite(p) or p >= ALPHA:
        return "No difference is shown; that is not the same as no difference."
    direction = "faster" if c.signed_rank.estimate < 0 else "slower"
    if not _corrected(c):
        return (
            f"Laps of {c.condition} tend to be {direction} than of {c.reference}; the test is "
            "exploratory, its p is not corrected."
        )
    return f"Laps of {c.condition} are {direction} than of {c.reference}."


def _p(c: PairedComparison) -> str:
    if _corrected(c):
        return f"Wilcoxon {is_p(c.p_holm)} after Holm"
    if c.signed_rank.computed:
        return f"Wilcoxon {is_p(c.signed_rank.p)}, not corrected"
    return f"no test: {c.signed_rank.why_not}"


def _corrected(c: PairedComparison) -> bool:
    """Return whether the corrected p is Wilcoxon's: with a margin, it is that of equivalence."""
    return math.isfinite(c.p_holm) and c.equivalence is None


def _missing(c: PairedComparison) -> str:
    return f" ({plural(c.incomplete, 'pair')} missing)" if c.incomplete else ""


def _why_not(c: PairedComparison) -> str:
    reasons = [r.why_not for r in (c.difference, c.signed_rank) if r is not None and r.why_not]
    found = reasons[0] if reasons else "there is nothing to compare"
    return f"{found} (n = {c.complete}, {c.incomplete} missing)"


def _cautions(results: StudyResults) -> list[str]:
    frames = results.frames
    found = []
    if frames.synthetic:
        found.append(
            "The participants are synthetic. The page shows what the simulation's assumptions "
            "imply; nothing on it is a finding about people. Questionnaire answers follow from "
            "assumed loadings in particular."
        )
    if order_confounded(frames):
        found.append(
            f"The place of a lap in the session follows from its condition{_but(frames)}: practice "
            "and condition are confounded. A difference between conditions may be practice in "
            f"part, and no test on these data can tell{_where_shown(results)}."
        )
    return found


def _where_shown(results: StudyResults) -> str:
    if results.practice.empty:
        return ""
    return "; the section on practice shows how much practice it would take"


def _but(frames: StudyFrames) -> str:
    others, people = other_orders(frames)
    return f" ({others} of {people} drove another order, too few to tell)" if others else ""


def _picture(chosen: tuple[PairedComparison, ...]) -> Picture:

    said = [
        f"{c.condition} minus {c.reference} {number(c.difference.estimate)} s "
        f"({interval(c.difference.low, c.difference.high)})"
        for c in chosen
        if c.difference is not None and c.difference.computed
    ]
    return Picture(
        name="effects",
        caption="Mean paired differences of lap times with 95% t intervals. Filled: confirmatory; "
        "open: exploratory. n is given above.",
        alternative=f"Differences of lap times: {'; '.join(said) or 'none can be computed'}.",
        figure=effect_figure(chosen),
    )
