"""Load a study and everything it refers to."""

import hashlib
from dataclasses import replace
from pathlib import Path
from typing import Any

from protocols.course.drivable import undrivable
from protocols.course.schema import Course
from protocols.files.document import spoken
from protocols.files.errors import InputError
from protocols.files.fault import Fault, Location
from protocols.files.validation import validate
from protocols.instrument import Instrument
from protocols.laps import AskedInstrument
from protocols.model_choice import BorrowedModel
from protocols.pages import Text
from protocols.parts import parts_beside
from protocols.questions import laps_with_items, question_faults, session_survey
from protocols.record.header import read_header
from protocols.resolved import ResolvedStudy
from protocols.shipped import Source, locate, locate_text, shipped_names
from protocols.study import StudyProtocol


def shipped_protocols() -> tuple[str, ...]:
    """Return the names of the shipped protocols, sorted.

    Examples
    --------
    >>> "four-lap" in shipped_protocols()
    True
    """
    return shipped_names("studies")


def shipped_courses() -> tuple[str, ...]:
    """Return the names of the shipped courses, sorted.

    Examples
    --------
    >>> shipped_courses()
    ('lab-office', 'lab-office-mirror', 'ward-corridor')
    """
    return shipped_names("courses")


def shipped_instruments() -> tuple[str, ...]:
    """Return the names of the shipped instruments, sorted.

    Examples
    --------
    >>> shipped_instruments()
    ('driving-assistance', 'nasa-tlx', 'sus')
    """
    return shipped_names("instruments")


def load_protocol(name_or_path: str) -> StudyProtocol:
    """Return a protocol as it is in its file, without looking up what it refers to.

    Parameters
    ----------
    name_or_path
        A shipped protocol's name, or a file's path.

    Raises
    ------
    InputError
        When there is no such file, or its content is not a protocol.

    Examples
    --------
    >>> load_protocol("four-lap").cohort.participants
    12
    """
    return validate(locate("studies", name_or_path).document(), StudyProtocol)


def load_course(name_or_path: str) -> Course:
    """Return a course that can be driven.

    Parameters
    ----------
    name_or_path
        A shipped course's name, or a file's path.

    Raises
    ------
    InputError
        When there is no such file, its content is not a course, or it cannot be driven.

    Examples
    --------
    >>> [gate.name for gate in load_course("lab-office").gates]
    ['R1', 'R2', 'F']
    """
    return _course(locate("courses", name_or_path))


def load_instrument(name_or_path: str) -> Instrument:
    """Return a questionnaire.

    Parameters
    ----------
    name_or_path
        A shipped instrument's name, or a file's path.

    Raises
    ------
    InputError
        When there is no such file, or its content is not an instrument.

    Examples
    --------
    >>> load_instrument("sus").score
    (0.0, 100.0)
    """
    return validate(locate("instruments", name_or_path).document(), Instrument)


def resolve_study(
    name_or_path: str, *, course: str | None = None, participants: int | None = None
) -> ResolvedStudy:
    """Return a study with its course and its instruments, checked against one another.

    Parameters
    ----------
    name_or_path
        A shipped protocol's name, or a file.
    course
        A shipped course's name or a file, in place of the protocol's own course.
    participants
        In place of the protocol's own number; 1 to 9999.

    Raises
    ------
    InputError
        In one line: file, line, field, what is wrong and what is allowed.

    Examples
    --------
    >>> study = resolve_study("four-lap", course="ward-corridor", participants=3)
    >>> study.course.name, study.protocol.cohort.participants
    ('ward-corridor', 3)
    """
    if participants is not None and not 1 <= participants <= 9999:
        raise InputError(f"participants: {participants} is out of range; allowed: 1 to 9999")
    source = locate("studies", name_or_path)
    document = source.document()
    protocol = validate(document, StudyProtocol)
    try:
        protocol = _with_texts(protocol, source.folder)
        chosen = (
            _referred_course(protocol, source.folder) if course is None else load_course(course)
        )
        group_courses = _group_courses(protocol, source.folder)
        instruments = _instruments(protocol, source.folder)
        protocol = _with_hashes(protocol, source.folder)
    except _ReferenceError as error:
        raise document.error([error.fault]) from None
    faults = tuple(question_faults(protocol, instruments))
    if faults:
        raise document.error(faults)
    beside = parts_beside(protocol, source.folder, document)
    elsewhere = course is not None and chosen.name != protocol.course
    study = _resolved(
        protocol, chosen, instruments, participants, source.folder, driven_elsewhere=elsewhere
    )
    places = {
        spoken(where): f"{document.source}:{line}"
        for where, line in document.lines.items()
        if where
    }
    return replace(study, beside=beside, places=places, **_by_group(study, group_courses))


def _by_group(study: ResolvedStudy, courses: dict[str, Course]) -> dict[str, Any]:
    """Return what groups with a course of their own change; they call it by its name."""
    groups = {
        name: group.model_copy(update={"course": courses[name].name} if name in courses else {})
        for name, group in study.protocol.groups.items()
    }
    protocol = study.protocol.model_copy(update={"groups": groups})
    return {"protocol": protocol, "group_courses": courses} if courses else {}


def check_file(name_or_path: str) -> ResolvedStudy | Course | Instrument:
    """Load a file of any kind, or anything that ships; a file's kind follows from its fields.

    Parameters
    ----------
    name_or_path
        A shipped file's name, or a file's path.

    Raises
    ------
    InputError
        When it is not a valid protocol, course or instrument.

    Examples
    --------
    >>> check_file("lab-office").name
    'lab-office'
    """
    if name_or_path in shipped_courses():
        return load_course(name_or_path)
    if name_or_path in shipped_instruments():
        return load_instrument(name_or_path)
    data = locate("studies", name_or_path).document().data
    fields = data.keys() if isinstance(data, dict) else ()
    if "walls" in fields or "gates" in fields:
        return load_course(name_or_path)
    if "items" in fields or "anchors" in fields:
        return load_instrument(name_or_path)
    return resolve_study(name_or_path)


class _ReferenceError(Exception):
    """A protocol refers to something that is not there."""

    def __init__(self, fault: Fault) -> None:
        super().__init__(fault.message)
        self.fault = fault


def _course(source: Source) -> Course:
    document = source.document()
    course = validate(document, Course)
    fault = undrivable(course)
    if fault is not None:
        raise document.error([fault])
    return course


def _referred_course(protocol: StudyProtocol, folder: Path | None) -> Course:
    try:
        source = locate("courses", protocol.course, folder)
    except InputError as error:
        raise _ReferenceError(Fault(("course",), str(error))) from None
    return _course(source)


def _group_courses(protocol: StudyProtocol, folder: Path | None) -> dict[str, Course]:
    """Return the courses of the groups that drive another one, by the group's name."""
    found = {}
    for name, group in protocol.groups.items():
        if group.course is None:
            continue
        try:
            found[name] = _course(locate("courses", group.course, folder))
        except InputError as error:
            raise _ReferenceError(Fault(("groups", name, "course"), str(error))) from None
    return found


def _with_texts(protocol: StudyProtocol, folder: Path | None) -> StudyProtocol:
    """Return the protocol with every page's text in place of the file that holds it."""
    texts = {
        field: _with_text(page, (field,), folder)
        for field in ("consent", "debrief")
        if (page := getattr(protocol, field)) is not None
    }
    live, page = protocol.live, protocol.live.instructions
    if page is not None:
        read = _with_text(page, ("live", "instructions"), folder)
        live = live.model_copy(update={"instructions": read})
    return protocol.model_copy(update={**texts, "live": live})


def _with_text(page: Text, where: Location, folder: Path | None) -> Text:
    if page.file is None:
        return page
    try:
        text = locate_text(page.file, folder)
    except InputError as error:
        raise _ReferenceError(Fault((*where, "file"), str(error))) from None
    return page.model_copy(update={"file": None, "text": text})


def _with_hashes(protocol: StudyProtocol, folder: Path | None) -> StudyProtocol:
    """Return the protocol with the hash of every model that is borrowed from outside."""
    models = {
        name: model.model_copy(update={"sha256": _hash(model, name, folder)})
        for name, model in protocol.models.items()
    }
    return protocol.model_copy(update={"models": models})


def _hash(model: BorrowedModel, name: str, folder: Path | None) -> str | None:
    """Return what identifies a borrowed model; None where each participant borrows another one.

    A file's is its SHA-256, a study's its digest.
    """
    if model.path is None or "{participant}" in model.path:
        return model.sha256
    path = (folder or Path()) / model.path
    at = ("models", name, "path")
    try:
        found = _sha256(path) if model.source == "file" else read_header(path).digest
    except (InputError, OSError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise _ReferenceError(Fault(at, f"{model.path}: cannot be borrowed: {reason}")) from None
    if model.sha256 not in (None, found):
        raise _ReferenceError(Fault(at, f"{model.path}: is not the model whose sha256 is given"))
    return found


def _sha256(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


def _instruments(protocol: StudyProtocol, folder: Path | None) -> dict[str, Instrument]:
    """Return the instruments by what the protocol calls them."""
    found: dict[str, Instrument] = {}
    asked: list[tuple[Location, AskedInstrument]] = [
        (("laps", i, "survey", j), survey)
        for i, lap in enumerate(protocol.laps)
        for j, survey in enumerate(lap.survey)
    ]
    asked += [(("survey", j), survey) for j, survey in enumerate(protocol.survey)]
    for at, survey in asked:
        if survey.instrument in found:
            continue
        where = (*at, "instrument")
        try:
            source = locate("instruments", survey.instrument, folder)
        except InputError as error:
            raise _ReferenceError(Fault(where, str(error))) from None
        instrument = validate(source.document(), Instrument)
        if instrument.name in (other.name for other in found.values()):
            message = f"another instrument of this study is named '{instrument.name}' too"
            raise _ReferenceError(Fault(where, message))
        found[survey.instrument] = instrument
    return found


def _resolved(
    protocol: StudyProtocol,
    course: Course,
    instruments: dict[str, Instrument],
    participants: int | None,
    folder: Path | None,
    *,
    driven_elsewhere: bool,
) -> ResolvedStudy:
    cohort = protocol.cohort
    if participants is not None:
        cohort = cohort.model_copy(update={"participants": participants})
    laps = laps_with_items(protocol, instruments)
    survey = session_survey(protocol, instruments)
    changes: dict[str, Any] = {
        "course": course.name,
        "laps": laps,
        "cohort": cohort,
        "survey": survey,
    }
    if driven_elsewhere:  # published figures belong to the course that the protocol names
        changes["replicates"] = None
    return ResolvedStudy(
        protocol.model_copy(update=changes), course, tuple(instruments.values()), folder=folder
    )
