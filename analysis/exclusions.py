"""Who is excluded: as it was recorded, else by the protocol's rules, applied to the laps."""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import pandas as pd

from analysis.measures.collisions import collisions
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
class _Lap:
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
    has_rules = rules.min_completed_laps is not None or rules.max_collisions is not None
    own = dict(iter(laps.groupby("participant")))
    none = laps.iloc[:0]
    excluded, reasons, applied = [], [], []
    against, unknown = [], []
    for person in people:
        who = person["participant"]
        driven = _driven(study, own.get(who, none)) if has_rules else []
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


def _driven(study: Study, laps: pd.DataFrame) -> list[_Lap]:
    """Return what the rules need; contacts are counted in the steps where laps have no number."""
    found = []
    columns = zip(laps["participant"], laps["lap"], laps["completed"], laps["collisions"],
                  strict=True)  # fmt: skip
    for who, lap, completed, counted in columns:
        contacts = float(counted) if pd.notna(counted) else _contacts(study, who, int(lap))
        known = math.isfinite(contacts)
        found.append(_Lap(bool(completed), int(contacts) if known else 0, known))
    return found


def _contacts(study: Study, who: str, lap: int) -> float:
    try:
        if not study.has_steps(who, lap):
            return float("nan")
        return collisions(study.steps(who, lap, ["contact"]).to_pandas())
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
