"""How good the sessions with living people were, and who is left out because of it."""

import pandas as pd

from analysis.figures.live_quality import quality_figure
from analysis.live_quality import LiveQuality
from analysis.report.blocks import Block, Caution, Paragraph, Picture, Section, Shown, table
from analysis.report.numbers import NOTHING, count, number, percent, plural
from analysis.results import StudyResults


def live_section(results: StudyResults) -> Section | None:
    """Return lateness, ages of inputs, round trips, interruptions, and exclusions by the rules."""
    found = results.live
    if found is None:
        return None
    blocks: list[Block] = [
        Paragraph(_summary(found)),
        _rules(found),
        table("live_quality", _ABOUT_PEOPLE, found.people, _PEOPLE),
        Picture(
            "live_quality",
            "Each person's steps: median to 99th percentile, and the maximum, over all laps but "
            "practice. Scale linear up to 1 ms, then logarithmic.",
            _in_words(found.people),
            quality_figure(found.people, _limits(results)),
        ),
        table("live_machines", "Browsers, machines and agreement, as the sessions' events say.",
              found.people, _MACHINES, folded=True),
    ]  # fmt: skip
    if len(found.events):
        blocks.append(table("live_events", "What happened beside driving, and who did it.",
                            found.events, _EVENTS))  # fmt: skip
    if len(found.checks):
        failed = int((~found.checks["passed"]).sum())
        blocks.append(
            table("attention_checks", f"Attention checks: {failed} of {len(found.checks)} were not "
                  "answered as asked. They are no part of any score.", found.checks, _CHECKS)
        )  # fmt: skip
    blocks += [Caution(f"Not read: {what}.") for what in found.unread]
    return Section("live", "Live session quality", tuple(blocks))


_ABOUT_PEOPLE = (
    "Sessions with living people, practice left out, excluded participants included. Late: from "
    "the moment a step was due to its start. Age: of the command in force. Sent: from the moment "
    "the browser sent the newest input to the step that used it. Interrupted: laps that were "
    "paused, stopped or disconnected."
)


def _summary(found: LiveQuality) -> str:
    people = found.people
    out = int(people["excluded"].sum())
    late = people["late_ms_p99"].max()
    return (
        f"{plural(len(people), 'session')} by the wall clock, {int(people['steps'].sum())} steps. "
        f"Largest 99th percentile of lateness: {number(late)} ms; of the command's age: "
        f"{number(people['input_age_ms_p99'].max(), 0)} ms; of the round trip: "
        f"{number(people['round_trip_ms_p99'].max(), 0)} ms. Laps interrupted: "
        f"{int(people['interruptions'].sum())}. Excluded, for this or another reason: {out}."
    )


def _rules(found: LiveQuality) -> Block:
    if found.rules.empty:
        return Paragraph(
            "The protocol declares no rule about the quality of a session (max_late_share, "
            "max_input_age_s, max_interruptions): nobody is left out because of it."
        )
    return table(
        "live_rules",
        "Rules that the protocol declared, applied to every participant's laps, practice left out.",
        found.rules,
        _RULES,
    )


def _limits(results: StudyResults) -> dict[str, float]:
    age = results.frames.study.protocol.exclusion.max_input_age_s
    return {} if age is None else {"input_age_ms": 1000.0 * age}


def _in_words(people: pd.DataFrame) -> str:
    said = (
        f"{row['participant']}: late {number(row['late_ms_p99'])} ms, command "
        f"{number(row['input_age_ms_p99'], 0)} ms old, round trip "
        f"{number(row['round_trip_ms_p99'], 0)} ms (99th percentiles)"
        for row in people.to_dict("records")
    )
    return "; ".join(said) + "."


def _text(value: object) -> str:
    return value if isinstance(value, str) and value else NOTHING


_RULES = [
    Shown("rule", lambda r: r["rule"], words=True),
    Shown("measured", lambda r: r["measure"], words=True),
    Shown("allowed", lambda r: f"{r['allowed']:g}"),
    Shown("worst", lambda r: number(r["worst"], 3)),
    Shown("participants", lambda r: count(r["participants"])),
    Shown("above", lambda r: count(r["above"])),
    Shown("who", lambda r: r["who"] or NOTHING, words=True),
]
_PEOPLE = [
    Shown("participant", lambda r: r["participant"], words=True),
    Shown("driver", lambda r: r["kind"], words=True),
    Shown("laps", lambda r: count(r["laps"])),
    Shown("steps", lambda r: count(r["steps"])),
    Shown("late p50 / ms", lambda r: number(r["late_ms_p50"], 2)),
    Shown("p99", lambda r: number(r["late_ms_p99"])),
    Shown("late steps", lambda r: percent(100 * r["late_share"], 1)),
    Shown("age p99 / ms", lambda r: count(r["input_age_ms_p99"])),
    Shown("sent p50 / ms", lambda r: count(r["sent_age_ms_p50"])),
    Shown("p99", lambda r: count(r["sent_age_ms_p99"])),
    Shown("round trip p50 / ms", lambda r: number(r["round_trip_ms_p50"])),
    Shown("p99", lambda r: number(r["round_trip_ms_p99"])),
    Shown("demonstrator's p50 / ms", lambda r: number(r["demonstrator_round_trip_ms_p50"])),
    Shown("pictures / s", lambda r: number(r["frames_per_s"])),
    Shown("not looking", lambda r: percent(100 * r["inattentive_share"], 1)),
    Shown("interrupted laps", lambda r: count(r["interruptions"])),
    Shown("paused / s", lambda r: number(r["paused_s"])),
    Shown("excluded", lambda r: _text(r["exclusion_reason"]) if r["excluded"] else "no",
          words=True),
]  # fmt: skip
_MACHINES = [
    Shown("participant", lambda r: r["participant"], words=True),
    Shown("browser, window, view", lambda r: _text(r["browser"]), words=True),
    Shown("machine check", lambda r: _text(r["machine"]), words=True),
    Shown("consent", lambda r: _text(r["consent"]), words=True),
]
_EVENTS = [
    Shown("event", lambda r: r["event"], words=True),
    Shown("by", lambda r: r["actor"], words=True),
    Shown("times", lambda r: count(r["times"])),
    Shown("participants", lambda r: count(r["participants"])),
]
_CHECKS = [
    Shown("participant", lambda r: r["participant"], words=True),
    Shown("condition", lambda r: r["condition"], words=True),
    Shown("item", lambda r: f"{r['instrument']}.{r['item']}", words=True),
    Shown("wanted", lambda r: f"{r['wanted']:g}"),
    Shown("given", lambda r: NOTHING if pd.isna(r["given"]) else f"{r['given']:g}"),
]
