"""The first answers of the report: did assistance help, how much, how sure."""

import math

from analysis.attainable import ALPHA
from analysis.comparisons import PairedComparison
from analysis.figures.effects import effect_figure
from analysis.frames import StudyFrames
from analysis.outcomes import by_participant
from analysis.practice import order_confounded, other_orders
from analysis.report.blocks import Block, Caution, Fact, Facts, Paragraph, Picture, Section
from analysis.report.numbers import count, interval, is_p, number, p_value, percent, plural
from analysis.report.sections.between import between_sentence
from analysis.report.sections.registration import said_of
from analysis.results import StudyResults
from analysis.roles import reference_condition
from analysis.stats.result import TestResult

_SMALL = 2.0
"""Change in percent below which whole numbers would hide it."""


def answer_section(results: StudyResults) -> Section:
    """Return the answers, each with its size and its certainty."""
    chosen = _chosen(results)
    blocks: list[Block] = []
    if results.registered is not None:
        blocks.append(Paragraph(said_of(results.registered)))
    if chosen:
        blocks.append(Facts(tuple(_fact(results, c) for c in chosen)))
        blocks += [Paragraph(_sentence(c)) for c in chosen]
    elif not results.between:
        blocks.append(Paragraph(_nothing_to_say(results)))
    timed = [c for c in results.between if c.outcome == "lap_time_s"]
    blocks += [Paragraph(between_sentence(c)) for c in timed]
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
    if not c.lead.computed:
        return Fact(question, "cannot be said", f"{_why_not(c)}.")
    wide = by_participant(results.frames, "lap_time_s")
    faster = int((wide[c.condition] < wide[c.reference]).sum())
    detail = (
        f"{_percent_interval(c.lead)}{_in_seconds(c)}; "
        f"{faster} of {plural(c.complete, 'participant')} faster; {_p(c)}"
    )
    return Fact(question, _size(c.lead), detail)


def _size(lead: TestResult) -> str:
    """Return how much faster or slower laps are, in percent of the reference's lap time."""
    change = 100 * math.expm1(lead.estimate)
    if not change:
        return "no difference"
    direction = "faster" if change < 0 else "slower"
    return f"{percent(abs(change), _digits(change))} {direction}"


def _digits(*changes: float) -> int:
    """Return how many decimals changes in percent need to say something."""
    return 1 if max(map(abs, changes)) < _SMALL else 0


def _percent_interval(lead: TestResult) -> str:
    if not math.isfinite(lead.low):
        return "; ".join(lead.notes) or "no interval"
    low, high = (100 * math.expm1(end) for end in (lead.low, lead.high))
    digits = _digits(low, high)
    return f"95% interval {number(low, digits)} to {percent(high, digits)} of the lap time"


def _in_seconds(c: PairedComparison) -> str:
    """Return the same in seconds, where the test of seconds has an estimate."""
    if c.lap_time is None or not c.lap_time.seconds.computed:
        return ""
    seconds = c.lap_time.seconds
    if not math.isfinite(seconds.low):
        return f"; {number(seconds.estimate)} s"
    return f"; {number(seconds.estimate)} s ({interval(seconds.low, seconds.high)})"


def _sentence(c: PairedComparison) -> str:
    kind = c.kind if c.declared else "not declared"
    start = f"{c.name[0].upper()}{c.name[1:]} ({kind}): "
    if not c.lead.computed:
        return f"{start}cannot be computed: {_why_not(c)}."
    ratio = c.ratio_of_means
    speedup = "" if ratio is None else f" (a ratio of {percent(100 * ratio.estimate)})"
    text = (
        f"{start}{c.condition} is {_size(c.lead)} than {c.reference}, {_percent_interval(c.lead)}"
        f"{_in_seconds(c)}; n = {count(c.complete)}{_missing(c)}; {_p(c)}. Means: {c.reference} "
        f"{number(c.mean_reference)} s, {c.condition} {number(c.mean_condition)} s{speedup}. "
        f"{_verdict(c)}{_of_practice(c)}{_of_unfinished(c)}"
    )
    if c.equivalence is not None and c.equivalence.computed:
        text += _equivalence(c, c.equivalence)
    return text.replace("is no difference than", "does not differ from")


def _equivalence(c: PairedComparison, found: TestResult) -> str:
    corrected = math.isfinite(c.p_holm)
    p = c.p_holm if corrected else found.p
    confounded = p < ALPHA and c.practice in ("confounded", "adjusted")
    shown = "not concluded" if confounded else "shown" if p < ALPHA else "not shown"
    why = ", and practice, which this test is not adjusted for, may hide a difference"
    notes = "".join(f" {note[0].upper()}{note[1:]}." for note in found.notes)
    return (
        f" Equivalence within the declared margin of ±{c.margin:g} {c.unit} is {shown} "
        f"(TOST {is_p(p)}, {'after Holm' if corrected else 'not corrected'}; 90% interval "
        f"{interval(found.low, found.high)} {c.unit}){why if confounded else ''}.{notes}"
    )


def _verdict(c: PairedComparison) -> str:
    p = c.p_holm if _corrected(c) else c.lead.p
    if not math.isfinite(p) or p >= ALPHA:
        if c.smallest_p > ALPHA:
            return (
                f"It could not have been significant with {plural(c.complete, 'complete pair')}: "
                f"the smallest p that is possible is {p_value(c.smallest_p)}."
            )
        return "No difference is shown; that is not the same as no difference."
    direction = "faster" if c.lead.estimate < 0 else "slower"
    if c.practice == "confounded":
        return (
            f"These laps were {direction}; no verdict on {c.condition} follows, because its place "
            "in the session is its own and may have done part of it."
        )
    if not _corrected(c):
        return (
            f"Laps of {c.condition} tend to be {direction} than of {c.reference}; the test is "
            "exploratory, its p is not corrected."
        )
    return f"Laps of {c.condition} are {direction} than of {c.reference}."


def _of_practice(c: PairedComparison) -> str:
    """Return what was done about practice, where something was."""
    if c.practice == "balanced":
        return " Each place in the session is balanced over both; its mean is taken off."
    if c.practice == "adjusted":
        return (
            " Place is not balanced over the two: the test is the mixed model's, with the place as "
            "a factor."
        )
    return ""


def _of_unfinished(c: PairedComparison) -> str:
    """Say so where the verdict depends on what an unfinished lap counts as."""
    significant = c.lead.p < ALPHA
    others = [
        f"{_COUNTED[t.unfinished]}, {is_p(t.test.p)}"
        for t in c.sensitivity
        if t.test.computed and (t.test.p < ALPHA) != significant
    ]
    if not others:
        return ""
    return (
        f" Whether p is below .05 depends on what an unfinished lap counts as: "
        f"{'; '.join(others)} (not corrected)."
    )


_COUNTED = {
    "complete pairs": "left out with its pair",
    "limit": "as its time limit",
    "worst rank": "as slower than every finished lap",
}


def _p(c: PairedComparison) -> str:
    test = "mixed model" if c.practice == "adjusted" else "Wilcoxon"
    if _corrected(c):
        return f"{test} {is_p(c.p_holm)} after Holm"
    if c.lead.computed:
        return f"{test} {is_p(c.lead.p)}, not corrected"
    return f"no test: {c.lead.why_not}"


def _corrected(c: PairedComparison) -> bool:
    """Return whether the corrected p is Wilcoxon's: with a margin, it is that of equivalence."""
    return math.isfinite(c.p_holm) and c.equivalence is None


def _missing(c: PairedComparison) -> str:
    return f" ({plural(c.incomplete, 'pair')} missing)" if c.incomplete else ""


def _why_not(c: PairedComparison) -> str:
    reasons = [r.why_not for r in (c.lead, c.signed_rank) if r.why_not]
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
    else:
        found += _unbalanced(results)
    return found


def _unbalanced(results: StudyResults) -> list[str]:
    """Caution about comparisons whose conditions have not had the same places."""
    pairs = dict.fromkeys(
        f"{c.condition} and {c.reference}" for c in _chosen(results) if c.practice == "adjusted"
    )
    if not pairs:
        return []
    text = (
        f"Place in the session is not balanced over {'; '.join(pairs)}: practice is told from the "
        "condition only by the mixed model, and rests on its assumptions."
    )
    return [text]


def _where_shown(results: StudyResults) -> str:
    if results.practice.empty:
        return ""
    return "; the section on practice shows how much practice it would take"


def _but(frames: StudyFrames) -> str:
    others, people = other_orders(frames)
    return f" ({others} of {people} drove another order, too few to tell)" if others else ""


def _picture(chosen: tuple[PairedComparison, ...]) -> Picture:
    said = [
        f"{c.condition} is {_size(c.lead)} than {c.reference}, {_percent_interval(c.lead)}"
        for c in chosen
        if c.lead.computed
    ]
    return Picture(
        name="effects",
        caption="Change of lap time against the reference, Hodges-Lehmann estimates of log ratios "
        "with 95% intervals. Filled: confirmatory; open: exploratory. n is given above.",
        alternative=f"Changes of lap times: {'; '.join(said) or 'none can be computed'}.",
        figure=effect_figure(chosen),
    )
