"""What was done against what was registered: kept, deviated, exploratory."""

from collections.abc import Sequence
from dataclasses import dataclass

import pandas as pd

from analysis.comparisons import PairedComparison
from analysis.frames import StudyFrames, as_frame
from analysis.group_comparisons import GroupComparison
from analysis.stats.result import TestResult
from analysis.versions import recording_versions
from protocols.files.errors import InputError
from protocols.order import group_of, in_words, laps_of
from protocols.record.amendment import plan_number
from protocols.record.enrolment import enrolled, slot_of
from protocols.registered_study import plan_differences, plan_study
from protocols.registration import REGISTRATION, Registration, read_registration


@dataclass(frozen=True, slots=True)
class Registered:
    """A study's registration, and how far it was kept.

    Attributes
    ----------
    digest, date
        Of the first plan.
    table
        One row per part of the plan: part, registered, done, and ``kept`` (kept, deviated).
    amendments
        Number, date and reason of each, and which sessions were before it, in words.
    before
        How many sessions were before the last amendment.
    recorded
        How many there are.
    fault
        Why the registration cannot be read; None when it can.
    """

    digest: str
    date: str
    table: pd.DataFrame
    amendments: tuple[str, ...] = ()
    before: int = 0
    recorded: int = 0
    fault: str | None = None

    @property
    def deviations(self) -> int:
        """How many parts of the plan were not kept."""
        return int((self.table["kept"] != "kept").sum()) if len(self.table) else 0


def registered_plan(
    frames: StudyFrames,
    declared: tuple[PairedComparison, ...],
    between: tuple[GroupComparison, ...] = (),
) -> Registered | None:
    """Compare a study with its registration; None for one without.

    Parameters
    ----------
    frames
        The study.
    declared, between
        Its declared comparisons, within participants and between groups, as they were computed.
    """
    study = frames.study
    digest = study.protocol.registration
    if digest is None:
        return None
    try:
        registration = read_registration(study.folder / REGISTRATION)
    except InputError as error:
        return Registered(digest, "", pd.DataFrame(), fault=str(error))
    rows = [
        _plan(frames, registration),
        _sample(frames, registration),
        _allocation(frames, registration),
        _versions(frames, registration),
        *(_analysis(c.name, c.lead) for c in declared if c.kind == "confirmatory"),
        *(_analysis(c.name, c.test) for c in between if c.kind == "confirmatory"),
    ]
    later = registration.heads[1:]
    return Registered(
        digest=digest,
        date=registration.heads[0].date,
        table=pd.DataFrame(rows, columns=["part", "registered", "done", "kept"]),
        amendments=tuple(
            f"Amendment {i}, {head.date}: {head.reason.rstrip('.')}. {_before(frames, i)}"
            for i, head in enumerate(later, start=1)
        ),
        before=_sessions_before(frames),
        recorded=len(frames.everybody),
        fault=None if registration.digest == digest else "another registration's folder",
    )


def _before(frames: StudyFrames, number: int) -> str:
    """Return which sessions were before an amendment, and which after it."""
    known = {a.number: a.sessions for a in frames.study.header.amended}
    recorded = tuple(frames.everybody["participant"])
    before = [who for who in recorded if who in known.get(number, ())]
    after = [who for who in recorded if who not in before]
    return f"Before it: {_people(before)}; after it: {_people(after)}"


def _people(names: Sequence[str]) -> str:
    if not names:
        return "no session"
    few = ", ".join(names) if len(names) <= _FEW else f"{names[0]}, {names[1]}, ..., {names[-1]}"
    return f"{len(names)} ({few})"


def _sessions_before(frames: StudyFrames) -> int:
    amended = frames.study.header.amended
    recorded = set(frames.everybody["participant"])
    return len(recorded.intersection(amended[-1].sessions)) if amended else 0


_FEW = 12
"""Names that are listed one by one."""

Row = tuple[str, str, str, str]


def _row(part: str, registered: str, done: str, *, kept: bool) -> Row:
    return part, registered, done, "kept" if kept else "deviated"


def _plan(frames: StudyFrames, registration: Registration) -> Row:
    found = tuple(plan_differences(frames.study.header.study, registration))
    done = "; ".join(found) or "the same"
    return _row("protocol, course, questionnaires", "as frozen", done, kept=not found)


def _sample(frames: StudyFrames, registration: Registration) -> Row:
    recorded = len(frames.everybody)
    if frames.study.header.origin == "live":  # people who left were replaced
        people = enrolled(frames.study.folder, map(str, frames.everybody["participant"]))
        recorded = sum(person.state == "usable" for person in people)
    wanted = registration.participants
    return _row("participants", str(wanted), str(recorded), kept=recorded == wanted)


def _allocation(frames: StudyFrames, registration: Registration) -> Row:
    """Compare every participant's recorded order and group with the allocation of the plan then."""
    seed = frames.study.seed or 0
    protocols = [
        plan_study(registration, number).protocol for number in range(len(registration.plans))
    ]
    people = as_frame(frames.study.participants)
    wrong = []
    for who, order, group in zip(
        people["participant"], people["order"], people["group"], strict=True
    ):
        slot = slot_of(frames.study.folder, str(who))
        protocol = frames.study.protocol
        if frames.study.header.amended:
            protocol = protocols[plan_number(frames.study.header, who)]
        given = in_words(laps_of(protocol, slot, seed)), group_of(protocol, slot, seed)
        if (order, None if pd.isna(group) else group) != given:
            wrong.append(str(who))
    done = f"{len(wrong)} otherwise ({', '.join(wrong[:5])})" if wrong else "the same"
    return _row("orders and groups", "from the plan's digest", done, kept=not wrong)


def _versions(frames: StudyFrames, registration: Registration) -> Row:
    wanted = registration.plan["versions"]
    used = {
        (name, version)
        for recording in recording_versions(frames.study)
        for name, version in recording.versions.items()
        if wanted.get(name) != version
    }
    done = ", ".join(f"{name} {version}" for name, version in sorted(used)) or "the same"
    program = f"lad-study {wanted.get('lad-study', '?')} and packages"
    return _row("versions", program, done, kept=not used)


def _analysis(name: str, test: TestResult) -> Row:
    done = "as declared" if test.computed else f"cannot be computed: {test.why_not}"
    return _row(f"analysis: {name}", "confirmatory", done, kept=test.computed)
