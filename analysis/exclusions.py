"""Who is excluded: as it was recorded, else by the protocol's rules, applied to the laps."""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import pandas as pd

from analysis.measures.collisions import collisions
from analysis.measures.streams import Steps
from protocols.exclusion import exclusion_reason
from protocols.files.errors import InputError
from protocols.record.reader import Study


@dataclass(frozen=True, slots=True)
class Exclusions:
    """Who is excluded, and how that is known.

    Attributes
    ----------
    excluded, reasons
        By row of the table of participants: whether, and the rule or what was recorded.
    looked
        Whether it is known of every participant: recorded, or every rule could be applied.
    by_rule
        Whether the protocol has a rule that could exclude.
    remarks
        What a reader has to know about it, in words.
    """

    excluded: list[bool]
    reasons: list[str | None]
    looked: bool
    by_rule: bool
    remarks: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class CountedLap:
    """What the rules need to know of a recorded lap; ``counted`` where its collisions are known."""

    completed: bool
    collisions: int
    counted: bool
    practice: bool = False
    end_reason: str = "finished"
    late_share: float | None = None
    input_age_p99_s: float | None = None
    pauses: int | None = None


def exclusions_of(study: Study, laps: pd.DataFrame) -> Exclusions:
    """Return who is excluded.

    Parameters
    ----------
    study
        The study.
    laps
        Every lap of it, practice laps left out.
    """
    people = study.participants.select(["participant", "excluded", "exclusion_reason"]).to_pylist()
    rules = study.protocol.exclusion
    has_rules = any(limit is not None for _, limit in rules)
    own = dict(iter(laps.groupby("participant")))
    none = laps.iloc[:0]
    excluded, reasons, applied = [], [], []
    against, unknown = [], []
    for person in people:
        who = person["participant"]
        driven = driven_laps(study, own.get(who, none)) if has_rules else []
        met = exclusion_reason(rules, driven)
        if person["excluded"] is not None:
            excluded.append(person["excluded"])
            reasons.append(person["exclusion_reason"] if person["excluded"] else None)
            if met and not person["excluded"]:
                against.append(f"{who} ({met})")
            continue
        excluded.append(met is not None)
        reasons.append(met)
        applied.append(who)
        gaps = not all(lap.counted for lap in driven)
        if met is None and rules.max_collisions is not None and gaps:
            unknown.append(who)
    remarks = (*_not_recorded(applied, excluded, has_rules=has_rules), *_unknown(unknown))
    looked = not unknown and (has_rules or not applied)
    return Exclusions(excluded, reasons, looked, has_rules, (*remarks, *_against(against)))


def driven_laps(study: Study, laps: pd.DataFrame) -> list[CountedLap]:
    """Return what the rules need; contacts are counted in the steps where laps have no number."""
    found = []
    for lap in laps.to_dict("records"):
        counted = lap["collisions"]
        contacts = (
            float(counted)
            if pd.notna(counted)
            else _contacts(study, lap["participant"], int(lap["lap"]))
        )
        known = math.isfinite(contacts)
        pauses = _given(lap["pauses"])
        found.append(
            CountedLap(
                completed=bool(lap["completed"]),
                collisions=int(contacts) if known else 0,
                counted=known,
                end_reason=str(lap["end_reason"]),
                late_share=_given(lap["late_share"]),
                input_age_p99_s=_given(lap["input_age_p99_s"]),
                pauses=None if pauses is None else int(pauses),
            )
        )
    return found


def _given(value: float | None) -> float | None:
    return None if value is None or pd.isna(value) else float(value)


def _contacts(study: Study, who: str, lap: int) -> float:
    try:
        if not study.has_steps(who, lap):
            return float("nan")
        return collisions(Steps(study.steps(who, lap, ["contact"])))
    except InputError:  # a damaged step table is named where the steps are read
        return float("nan")


def _not_recorded(applied: list[str], excluded: list[bool], *, has_rules: bool) -> Iterator[str]:
    if applied and has_rules:
        yield (
            f"Who is excluded was not recorded of {_people(len(applied))}: the protocol's rules "
            f"were applied to the recorded laps, and exclude {sum(excluded)}"
        )
    elif applied:
        yield (
            f"Who is excluded was not recorded of {_people(len(applied))}, and the protocol has no "
            "rule: they are analysed"
        )


def _unknown(unknown: list[str]) -> Iterator[str]:
    if unknown:
        yield (
            f"Whether {_people(len(unknown))} collided too often is not known, for collisions of "
            f"some laps were not recorded: they are analysed ({_some(unknown)})"
        )


def _against(against: list[str]) -> Iterator[str]:
    if against:
        yield (
            f"{_people(len(against))} recorded as not excluded would be excluded by the protocol's "
            f"rules, and {'is' if len(against) == 1 else 'are'} analysed ({_some(against)})"
        )


def _people(n: int) -> str:
    return "1 participant" if n == 1 else f"{n} participants"


def _some(names: list[str]) -> str:
    return ", ".join(names[:5]) + (f", ... ({len(names)} in all)" if len(names) > 5 else "")
