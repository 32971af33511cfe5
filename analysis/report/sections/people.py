"""Participants flow, and who they were."""

import pandas as pd

from analysis.flow import Flow
from analysis.report.blocks import Block, Caution, Paragraph, Section, Shown, Table, table
from analysis.report.numbers import count, number, plural
from analysis.results import StudyResults
from analysis.stats.describe import describe


def people_section(results: StudyResults) -> Section:
    """Return the numbers planned, recorded, excluded and why, and analysed; and the laps driven."""
    frames = results.frames
    blocks: list[Block] = [
        table("participants_flow", "Participants flow.", _stages(results.flow),
              [Shown("stage", lambda r: r["stage"], words=True),
               Shown("participants", lambda r: count(r["participants"]))]),
        table("laps_flow", f"Laps of those analysed (n = {results.flow.analysed}): planned = "
              "finished + unfinished + not driven.", results.flow.laps, _LAPS),
    ]  # fmt: skip
    if len(results.flow.withdrawals):
        blocks.append(_why_they_left(results.flow.withdrawals))
    blocks.append(Paragraph(_who(results.frames.participants)))
    about_exclusion = Caution if frames.exclusions.by_rule else Paragraph
    blocks += [about_exclusion(f"{remark}.") for remark in frames.exclusions.remarks]
    blocks += [Caution(f"Repaired on reading: {remark}.") for remark in frames.study.remarks]
    blocks += [Caution(f"Not analysed: {what}.") for what in results.flow.left_out]
    blocks += [Caution(f"Not read, and treated as missing: {what}.") for what in _unread(results)]
    if results.records.without_steps:
        blocks.append(
            Paragraph(
                f"{plural(results.records.without_steps, 'lap')} came without steps (no step "
                "table, an empty or a damaged one): lap times and answers are analysed, measures "
                "from steps are missing there."
            )
        )
    if results.records.unrecorded:
        blocks.append(
            Paragraph(
                f"Not recorded in any step: {', '.join(results.records.unrecorded)}. What follows "
                "from these columns cannot be computed, and is shown as missing."
            )
        )
    blocks += [Caution(f"{_sentence(what)}.") for what in results.records.misplaced]
    blocks += [
        Caution(f"In the steps of {plural(laps, 'lap')}, {gap}.")
        for gap, laps in results.records.gaps.items()
    ]
    return Section("participants", "Participants", tuple(blocks))


def _sentence(text: str) -> str:
    return f"{text[:1].upper()}{text[1:]}"


def _unread(results: StudyResults) -> tuple[str, ...]:
    return (*results.frames.unread, *results.records.damaged)


_LAPS = [
    Shown("condition", lambda r: r["condition"], words=True),
    Shown("planned", lambda r: count(r["planned"])),
    Shown("finished", lambda r: count(r["finished"])),
    Shown("of these without a time", lambda r: count(r["finished_without_time"])),
    Shown("time limit", lambda r: count(r["time_limit"])),
    Shown("withdrew", lambda r: count(r["withdrew"])),
    Shown("otherwise unfinished", lambda r: count(r["unfinished_otherwise"])),
    Shown("not driven", lambda r: count(r["not_driven"])),
]


def _why_they_left(withdrawals: pd.DataFrame) -> Table:
    return table(
        "withdrawals",
        f"Withdrawals ({len(withdrawals)}), practice laps and excluded participants included, in "
        "the participants' own words.",
        withdrawals,
        [
            Shown("participant", lambda r: str(r["participant"]), words=True),
            Shown("lap", lambda r: count(r["lap"])),
            Shown("condition", lambda r: str(r["condition"]), words=True),
            Shown("why", lambda r: _words(r["withdrawal"]), words=True),
        ],
    )


def _words(said: object) -> str:
    return said if isinstance(said, str) and said.strip() else "no reason recorded"


def _stages(flow: Flow) -> pd.DataFrame:
    stages = [
        *_before(flow),
        ("recorded", flow.recorded),
        ("less: consent refused", flow.refused),
        *((f"less: excluded: {reason}", n) for reason, n in flow.excluded.items()),
        ("analysed", flow.analysed),
        *([("of these, consent not recorded", flow.consent_unknown)] * bool(flow.consent_unknown)),
        ("of these, finished every planned lap (practice apart)", flow.completed),
    ]
    return pd.DataFrame(stages, columns=["stage", "participants"])


def _before(flow: Flow) -> list[tuple[str, int]]:
    """Return the stages up to the recorded ones; fewer where the planned number is unknown."""
    broke_off = ("less: session broke off with an error", flow.failed)
    if flow.planned is None:
        return [
            ("begun (how many were planned is not said)", flow.recorded + flow.failed),
            broke_off,
        ]
    return [("planned", flow.planned), ("less: session not run", flow.not_run), broke_off]


def _who(people: pd.DataFrame) -> str:
    ages = describe(pd.to_numeric(people["age_years"]))
    parts = [f"Analysed: {plural(len(people), 'participant')}"]
    if ages.n:
        parts.append(
            f"age {number(ages.low, 0)} to {number(ages.high, 0)} years (mean {number(ages.mean)}, "
            f"sd {number(ages.sd, 2)}, {ages.missing} not given)"
        )
    for name in ("gender", "handedness", "kind", "impairment"):
        known = people[name].dropna().value_counts()
        if len(known):
            said = ", ".join(f"{value} {n}" for value, n in sorted(known.items()))
            parts.append(f"{name}: {said}")
    return "; ".join(parts) + "."
