"""A study with everything it refers to."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from protocols.code_beside import PartBeside
from protocols.course.schema import Course
from protocols.instrument import Instrument, Item
from protocols.laps import AskedInstrument, PlannedLap
from protocols.study import StudyProtocol


@dataclass(frozen=True, slots=True)
class ResolvedStudy:
    """A protocol, its course and its instruments.

    Attributes
    ----------
    protocol
        Refers to course and instruments by their names, and to every item by its id.
    course
        The course of that name.
    instruments
        The instruments asked after any lap, in the order of their first use.
    group_courses
        The courses of groups that drive another one, by the group's name.
    folder
        Where relative paths in the components' options start; None for a shipped protocol. Not
        part of what the study is.
    beside
        The parts whose code lies beside the protocol file; not part of what the study is.
    places
        Where the protocol file says what: file and line by field; empty for a recorded study.
    trusted
        Whether that code may be run: a person said so.
    """

    protocol: StudyProtocol
    course: Course
    instruments: tuple[Instrument, ...]
    group_courses: Mapping[str, Course] = field(default_factory=dict)
    folder: Path | None = field(default=None, compare=False)
    beside: tuple[PartBeside, ...] = field(default=(), compare=False)
    places: Mapping[str, str] = field(default_factory=dict, compare=False)
    trusted: bool = field(default=False, compare=False)

    @property
    def code(self) -> tuple[PartBeside, ...]:
        """The parts beside the protocol file whose code may be run."""
        return self.beside if self.trusted else ()

    def at(self, where: str) -> str:
        """Return how a message about a field of the protocol begins: file, line, field."""
        while where not in self.places and "." in where:
            where = where.rpartition(".")[0]
        return f"{self.places[where]}: {where}: " if where in self.places else ""

    def instrument(self, name: str) -> Instrument:
        """Return the instrument of this name; ``KeyError`` when the study has none."""
        for instrument in self.instruments:
            if instrument.name == name:
                return instrument
        raise KeyError(name)

    def questions(self, planned: PlannedLap) -> tuple[tuple[Instrument, Item], ...]:
        """Return what is asked after a planned lap, in order."""
        return self._asked(planned.survey)

    @property
    def session_questions(self) -> tuple[tuple[Instrument, Item], ...]:
        """What is asked once, after the last lap, in order."""
        return self._asked(self.protocol.survey)

    def _asked(self, surveys: tuple[AskedInstrument, ...]) -> tuple[tuple[Instrument, Item], ...]:
        asked = []
        for survey in surveys:
            instrument = self.instrument(survey.instrument)
            asked += [(instrument, instrument.item(item)) for item in survey.items]
        return tuple(asked)
