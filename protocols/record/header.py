"""The head of a study directory: ``study.yaml``."""

import platform
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any, Literal, Self

from pydantic import Field, model_validator

from protocols.course.schema import Course
from protocols.files.document import parse
from protocols.files.dump import to_yaml
from protocols.files.errors import InputError
from protocols.files.file_model import FileModel, FormatVersion
from protocols.files.validation import validate
from protocols.instrument import Instrument
from protocols.record.atomic import write_whole
from protocols.record.column import SCHEMA_VERSION, SchemaVersion
from protocols.record.identity import study_digest
from protocols.resolved import ResolvedStudy
from protocols.study import StudyProtocol
from protocols.versions import package_versions

STUDY_FILE = "study.yaml"


Origin = Literal["simulated", "live", "elsewhere"]
"""Where a study comes from: synthetic participants here, living people here, or other programs."""


def _origin_of_version_1(data: Mapping[str, Any]) -> Origin:
    return "elsewhere" if data.get("seed") is None else "simulated"


class AmendedStudy(FileModel):
    """An amendment that took effect in a study under way.

    Attributes
    ----------
    number
        Of the amendment, counted from 1.
    sessions
        Participants whose sessions were there before it.
    """

    number: Annotated[int, Field(ge=1)]
    sessions: tuple[str, ...] = ()


class StudyHeader(FileModel):
    """The head of a study directory: which study it holds.

    Attributes
    ----------
    protocol, course, instruments, group_courses
        The study as it was resolved.
    origin
        Where the study comes from. A header of version 1 lacks it: with a seed it was
        simulated, without one recorded elsewhere.
    seed
        None for a study that was recorded elsewhere.
    digest
        Of protocol, course, instruments and seed, not of the number of participants; of an amended
        study, as it was in the beginning.
    amended
        Amendments of the registration that took effect when sessions were there already.
    versions, platform
        Of the run that made the directory; every session's manifest has its own.
    """

    schema_version: Annotated[SchemaVersion, FormatVersion, Field(alias="schema")] = SCHEMA_VERSION
    seed: Annotated[int, Field(ge=0)] | None = None
    origin: Origin = Field(default_factory=_origin_of_version_1)
    digest: str | None = None
    platform: str | None = None
    amended: tuple[AmendedStudy, ...] = ()
    versions: dict[str, str] = Field(default_factory=dict)
    protocol: StudyProtocol
    instruments: tuple[Instrument, ...] = ()
    course: Course
    group_courses: dict[str, Course] = Field(default_factory=dict)

    @model_validator(mode="after")
    def _a_seed_unless_elsewhere(self) -> Self:
        if self.origin != "elsewhere" and self.seed is None:
            raise ValueError(f"origin: {self.origin} needs a seed")
        return self

    @property
    def planned_participants(self) -> int | None:
        """How many people were planned; None where a study from elsewhere does not give it."""
        cohort = self.protocol.cohort
        said = {"cohort"} <= self.protocol.model_fields_set
        if self.origin == "elsewhere" and not (said and "participants" in cohort.model_fields_set):
            return None
        return cohort.participants

    @property
    def study(self) -> ResolvedStudy:
        """The study, with everything it refers to."""
        return ResolvedStudy(self.protocol, self.course, self.instruments, self.group_courses)


def header_of(study: ResolvedStudy, seed: int, origin: Origin = "simulated") -> StudyHeader:
    """Return the head of a study that is about to be run here."""
    return StudyHeader(
        origin=origin,
        seed=seed,
        digest=study_digest(study, seed),
        platform=platform.platform(),
        versions=package_versions(),
        protocol=study.protocol,
        instruments=study.instruments,
        course=study.course,
        group_courses=dict(study.group_courses),
    )


def write_header(folder: Path, header: StudyHeader) -> None:
    """Write ``study.yaml``, whole or not at all."""
    write_whole(folder / STUDY_FILE, to_yaml(header).encode())


def read_header(folder: Path) -> StudyHeader:
    """Return the head of a study directory.

    Raises
    ------
    InputError
        When the folder is no study directory, or its ``study.yaml`` cannot be used.
    """
    path = folder / STUDY_FILE
    if not folder.is_dir():
        what = "is a file, not a study directory" if folder.exists() else "no such folder"
        raise InputError(f"{folder}: {what}")
    if not path.is_file():
        raise InputError(f"{folder}: not a study directory; there is no {STUDY_FILE} in it")
    try:
        content = path.read_bytes()
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror}") from None
    return validate(parse(content, str(path)), StudyHeader)
