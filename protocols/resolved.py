"""A study with everything it refers to: nothing left to look up."""

from dataclasses import dataclass, field
from pathlib import Path

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
    folder
        Where relative paths in the components' options start; None for a shipped protocol. Not
        part of what the study is.
    """

    protocol: StudyProtocol
    course: Course
    instruments: tuple[Instrument, ...]
    folder: Path | None = field(default=None, compare=False)

    def instrument(self, name: str) -> Instrument:
        """Return the instrument of this name; ``KeyError`` when the study asks no such one."""
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
