"""What was done against what was registered: kept, deviated, exploratory."""

from dataclasses import dataclass

import pandas as pd

from analysis.comparisons import PairedComparison
from analysis.frames import StudyFrames, as_frame
from analysis.versions import recording_versions
from protocols.files.errors import InputError
from protocols.order import group_of, in_words, laps_of
from protocols.record.enrolment import enrolled, slot_of
from protocols.registration import REGISTRATION, Registration, plan_differences, read_registration


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
        Number, date and reason of each, in words.
    fault
        Why the registration cannot be read; None when it can.
    """

    digest: str
    date: str
    table: pd.DataFrame
    amendments: tuple[str, ...] = ()
    fault: str | None = None

    @property
    def deviations(self) -> int:
        """How many parts of the plan were not kept."""
        return int((self.table["kept"] != "kept").sum()) if len(self.table) else 0


def registered_plan(
    frames: StudyFrames, declared: tuple[PairedComparison, ...]
) -> Registered | None:
    """Compare a study with its registration; None for one without.

    Parameters
    ----------
    frames
        The study.
    declared
        Its declared comparisons, as they were computed.
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
        _allocation(frames),
        _versions(frames, registration),
        *(_analysis(c) for c in declared if c.kind == "confirmatory"),
    ]
    later = registration.heads[1:]
    return Registered(
        digest=digest,
        date=registration.heads[0].date,
        table=pd.DataFrame(rows, columns=["part", "registered", "done", "kept"]),
        amendments=tuple(
            f"Amendment {i}, {head.date}: {head.reason}" for i, head in enumerate(later, start=1)
        ),
        fault=None if registration.digest == digest else "another registration's folder",
    )


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
        people = enrolled(frames.study.folder, map(str, frames.everybody))
        recorded = sum(person.state == "usable" for person in people)
    wanted = registration.participants
    return _row("participants", str(wanted), str(recorded), kept=recorded == wanted)


def _allocation(frames: StudyFrames) -> Row:
    """Compare every participant's recorded order and group with the registered allocation."""
    protocol, seed = frames.study.protocol, frames.study.seed or 0
    people = as_frame(frames.study.participants)
    wrong = []
    for who, order, group in zip(
        people["participant"], people["order"], people["group"], strict=True
    ):
        slot = slot_of(frames.study.folder, str(who))
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


def _analysis(c: PairedComparison) -> Row:
    done = "as declared" if c.lead.computed else f"cannot be computed: {c.lead.why_not}"
    return _row(f"analysis: {c.name}", "confirmatory", done, kept=c.lead.computed)
