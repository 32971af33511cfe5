"""Which questions a protocol asks, once its instruments are known."""

from collections.abc import Iterator, Mapping

from protocols.files.fault import Fault
from protocols.files.suggestion import allowed
from protocols.instrument import Instrument
from protocols.laps import AskedInstrument, PlannedLap
from protocols.study import StudyProtocol

Instruments = Mapping[str, Instrument]
"""A study's instruments, by what its protocol calls them (a name or a path)."""


def laps_with_items(protocol: StudyProtocol, instruments: Instruments) -> tuple[PlannedLap, ...]:
    """Return the planned laps with every instrument by its own name and every item by its id."""
    return tuple(
        lap.model_copy(
            update={
                "survey": tuple(
                    AskedInstrument(
                        instrument=instruments[survey.instrument].name,
                        items=asked_items(protocol, lap, survey, instruments[survey.instrument]),
                    )
                    for survey in lap.survey
                )
            }
        )
        for lap in protocol.laps
    )


def session_survey(
    protocol: StudyProtocol, instruments: Instruments
) -> tuple[AskedInstrument, ...]:
    """Return what is asked after the last lap, every item by its id."""
    return tuple(
        AskedInstrument(
            instrument=instruments[asked.instrument].name,
            items=instruments[asked.instrument].ids(assisted=True)
            if asked.items == "all"
            else asked.items,
        )
        for asked in protocol.survey
    )


def question_faults(protocol: StudyProtocol, instruments: Instruments) -> Iterator[Fault]:
    """Find questions that do not exist, and comparisons of answers that no lap asks for."""
    yield from _survey_faults(protocol, instruments)
    yield from _session_faults(protocol, instruments)
    yield from _outcome_faults(protocol, instruments)


def _survey_faults(protocol: StudyProtocol, instruments: Instruments) -> Iterator[Fault]:
    for i, lap in enumerate(protocol.laps):
        for j, survey in enumerate(lap.survey):
            instrument = instruments[survey.instrument]
            ids = instrument.ids(assisted=True)
            asked = asked_items(protocol, lap, survey, instrument)
            if not asked:
                message = f"no item of '{instrument.name}' applies to a lap without assistance"
                yield Fault(("laps", i, "survey", j), message)
            for k, item in enumerate(asked):
                if item not in ids:
                    hint = allowed(item, ids)
                    message = f"'{item}' is not an item of '{instrument.name}'; {hint}"
                    yield Fault(("laps", i, "survey", j, "items", k), message)


def _session_faults(protocol: StudyProtocol, instruments: Instruments) -> Iterator[Fault]:
    for j, survey in enumerate(protocol.survey):
        ids = instruments[survey.instrument].ids(assisted=True)
        for k, item in enumerate(survey.items if survey.items != "all" else ()):
            if item not in ids:
                hint = allowed(item, ids)
                message = f"'{item}' is not an item of '{survey.instrument}'; {hint}"
                yield Fault(("survey", j, "items", k), message)


def _outcome_faults(protocol: StudyProtocol, instruments: Instruments) -> Iterator[Fault]:
    asked = {
        (lap.condition, instruments[survey.instrument].name, item)
        for lap in protocol.laps
        if not lap.practice
        for survey in lap.survey
        for item in asked_items(protocol, lap, survey, instruments[survey.instrument])
    }
    for i, comparison in enumerate(protocol.analyses):
        if comparison.item is None:
            continue
        name, item = comparison.item
        meant = answering(instruments, name, item)
        for condition in comparison.conditions:
            if not any((condition, name, one) in asked for one in meant):
                message = f"'{item}' of '{name}' is not asked after a lap of '{condition}'"
                yield Fault(("analyses", i, "outcome"), message)


def answering(instruments: Instruments, name: str, item: str) -> tuple[str, ...]:
    """Return the items that an outcome means: an item, or every item of a subscale."""
    for instrument in instruments.values():
        if instrument.name == name:
            return instrument.answering(item)
    return ()


def asked_items(
    protocol: StudyProtocol, lap: PlannedLap, survey: AskedInstrument, instrument: Instrument
) -> tuple[str, ...]:
    """Return the ids of the items of an instrument that are asked after a lap."""
    if survey.items != "all":
        return survey.items
    assisted = protocol.conditions[lap.condition].assistant != "none"
    return instrument.ids(assisted=assisted)
