"""How good living people's sessions were: time kept, inputs' ages, round trips, interruptions."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from analysis.exclusions import driven_laps
from analysis.frames import StudyFrames, as_frame, practised, within
from protocols.exclusion import Link, link_of
from protocols.files.errors import InputError
from protocols.record.reader import Study

STREAMS = {
    "late_ms": ("late_s", 1000.0),
    "input_age_ms": ("input_age_s", 1000.0),
    "sent_age_ms": ("driver_sent_age_s", 1000.0),
    "round_trip_ms": ("driver_round_trip_s", 1000.0),
    "demonstrator_round_trip_ms": ("demonstrator_round_trip_s", 1000.0),
}
"""What is described of each person: the column of the step tables, and what it is multiplied by."""

_COLUMNS = ("t_s", "driver_frames", "driver_attentive", *(name for name, _ in STREAMS.values()))
_RULES = {
    "max_late_share": ("late_share", "share of late steps in a lap"),
    "max_input_age_s": ("input_age_s", "99th percentile of the command's age in a lap, s"),
    "max_interruptions": ("interruptions", "interrupted laps"),
}


@dataclass(frozen=True, slots=True)
class LiveQuality:
    """The quality of the sessions in which living people took part; practice laps left out.

    Attributes
    ----------
    people
        One row per participant: laps, steps, median, 99th percentile and maximum of every stream
        (``late_ms_p50`` ...), pictures drawn a second, share of steps without attention, what the
        rules measure, pauses, whether excluded and why, and browser, view, machine and consent as
        the events say.
    rules
        One row per rule about the link that the protocol declares: what it allows, the worst
        value, and who is above it.
    events
        How often what happened: actor, event, times, participants.
    checks
        One row per attention check asked: participant, condition, instrument, item, wanted, given.
    unread
        What could not be read, in words.
    """

    people: pd.DataFrame
    rules: pd.DataFrame
    events: pd.DataFrame
    checks: pd.DataFrame
    unread: tuple[str, ...] = ()


def live_quality(frames: StudyFrames) -> LiveQuality | None:
    """Return the quality of a study's live sessions; None where nobody living took part."""
    laps = as_frame(frames.study.laps)
    everybody = frames.everybody
    timed = laps.loc[laps["late_share"].notna(), "participant"]
    living = everybody[(everybody["kind"] == "live") | everybody["participant"].isin(timed)]
    if living.empty:
        return None
    counted = laps[~practised(laps)]
    events, unread = _events(frames.study)
    rows, links = [], {}
    for person in living.to_dict("records"):
        own = counted[counted["participant"] == person["participant"]]
        links[person["participant"]] = link_of(driven_laps(frames.study, own))
        row, faults = _person(frames.study, person, own, links[person["participant"]])
        rows.append(row | _said(events[events["participant"] == person["participant"]]))
        unread += faults
    return LiveQuality(
        people=pd.DataFrame(rows),
        rules=_rules(frames.study, links),
        events=_counted(events),
        checks=_checks(frames),
        unread=unread,
    )


def _person(
    study: Study, person: dict[Any, Any], laps: pd.DataFrame, link: Link
) -> tuple[dict[str, Any], tuple[str, ...]]:
    who = person["participant"]
    steps, faults = _steps(study, who, laps["lap"])
    row: dict[str, Any] = {"participant": who, "kind": person["kind"], "laps": len(laps)}
    row["steps"] = len(steps)
    for name, (column, factor) in STREAMS.items():
        values = factor * _numbers(steps, column)
        row |= {f"{name}_{of}": value for of, value in _spread(values).items()}
    drawn, seconds = _numbers(steps, "driver_frames"), float(laps["duration_s"].sum())
    row["frames_per_s"] = drawn.sum() / seconds if len(drawn) and seconds else np.nan
    attentive = _numbers(steps, "driver_attentive")
    row["inattentive_share"] = 1 - attentive.mean() if len(attentive) else np.nan
    row |= link._asdict()
    row["pauses"] = float(pd.to_numeric(laps["pauses"]).sum())
    row["paused_s"] = float(pd.to_numeric(laps["paused_s"]).sum())
    row |= {"excluded": bool(person["excluded"]), "exclusion_reason": person["exclusion_reason"]}
    return row, faults


def _steps(study: Study, who: str, laps: pd.Series) -> tuple[pd.DataFrame, tuple[str, ...]]:
    read, faults = [], []
    for lap in laps:
        try:
            if study.has_steps(who, int(lap)):
                read.append(as_frame(study.steps(who, int(lap), _COLUMNS)))
        except InputError as error:
            faults.append(within(study, error))
    empty = pd.DataFrame(columns=list(_COLUMNS))
    return (pd.concat(read, ignore_index=True) if read else empty), tuple(faults)


def _numbers(steps: pd.DataFrame, column: str) -> NDArray[np.float64]:
    return steps[column].dropna().to_numpy(dtype=np.float64)


def _spread(values: NDArray[np.float64]) -> dict[str, float]:
    if not len(values):
        return dict.fromkeys(("p50", "p99", "max"), np.nan)
    p50, p99 = np.quantile(values, [0.5, 0.99])
    return {"p50": float(p50), "p99": float(p99), "max": float(values.max())}


def _rules(study: Study, links: dict[str, Link]) -> pd.DataFrame:
    rows = []
    for rule, (measure, meaning) in _RULES.items():
        allowed = getattr(study.protocol.exclusion, rule)
        if allowed is None:
            continue
        values = {who: float(getattr(link, measure)) for who, link in links.items()}
        above = sorted(who for who, value in values.items() if value > allowed)
        rows.append(
            {"rule": rule, "measure": meaning, "allowed": float(allowed),
             "worst": max(values.values()), "participants": len(values), "above": len(above),
             "who": ", ".join(above)}
        )  # fmt: skip
    columns = ["rule", "measure", "allowed", "worst", "participants", "above", "who"]
    return pd.DataFrame(rows, columns=columns)


def _events(study: Study) -> tuple[pd.DataFrame, tuple[str, ...]]:
    try:
        return as_frame(study.events), ()
    except InputError as error:
        empty = pd.DataFrame(columns=["participant", "lap", "actor", "event", "note"])
        return empty, (within(study, error),)


_ABOUT = {"browser": "browser", "machine check": "machine", "machine check failed": "machine",
          "consent": "consent"}  # fmt: skip
"""Events that say something about a person's machine or agreement, and what they say."""


def _said(events: pd.DataFrame) -> dict[str, str | None]:
    """Return what the last event of each kind says."""
    said: dict[str, str | None] = dict.fromkeys(dict.fromkeys(_ABOUT.values()))
    for event in events.to_dict("records"):
        if event["event"] in _ABOUT:
            failed = "failed: " if str(event["event"]).endswith("failed") else ""
            said[_ABOUT[event["event"]]] = f"{failed}{event['note'] or ''}"
    return said


def _counted(events: pd.DataFrame) -> pd.DataFrame:
    if events.empty:
        return pd.DataFrame(columns=["actor", "event", "times", "participants"])
    by_kind = events[~events["event"].isin(_ABOUT)].groupby(["actor", "event"])
    found = by_kind["participant"].agg(times="size", participants="nunique")
    return found.reset_index()


def _checks(frames: StudyFrames) -> pd.DataFrame:
    columns = ["participant", "condition", "instrument", "item", "wanted", "given", "passed"]
    return pd.DataFrame(list(_each_check(frames)), columns=columns)


def _each_check(frames: StudyFrames) -> Iterator[dict[str, Any]]:
    for instrument in frames.study.instruments:
        for item in instrument.items:
            if item.expected is None:
                continue
            asked = frames.answers[
                (frames.answers["instrument"] == instrument.name)
                & (frames.answers["item"] == item.id)
            ]
            column = "response" if item.answer == "point" else "response_number"
            for row in asked.to_dict("records"):
                given = row[column]
                yield {
                    **{name: row[name] for name in ("participant", "condition", "instrument")},
                    "item": item.id, "wanted": float(item.expected), "given": given,
                    "passed": bool(given == item.expected),
                }  # fmt: skip
