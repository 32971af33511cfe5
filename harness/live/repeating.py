"""Living people's parts that first repeat what an earlier process has noted."""

from dataclasses import replace

from harness.session.journal import FileJournal
from harness.session.lap import LapParts
from harness.session.parts import SessionParts
from harness.session.replay import (
    ReplayedDemonstrator,
    ReplayedDriver,
    ReplayedReader,
    ReplayedRespondent,
)
from participants.driver import kind_of
from participants.live.demonstrator import LiveDemonstrator
from participants.live.pages import LiveReader, LiveRespondent


def repeating(parts: SessionParts, journal: FileJournal) -> SessionParts:
    """Return a session's parts; the living ones begin with what is left in a journal.

    Parameters
    ----------
    parts
        Of one participant.
    journal
        The participant's, as an earlier process left it; empty for a new session.
    """
    driver, demonstrator = parts.lap.driver, parts.lap.demonstrator
    if kind_of(driver) == "live":
        driver = ReplayedDriver(journal, "live", driver)
    if isinstance(demonstrator, LiveDemonstrator):
        demonstrator = ReplayedDemonstrator(journal, demonstrator)
    respondent, reader = parts.respondent, parts.reader
    if isinstance(respondent, LiveRespondent):
        respondent = ReplayedRespondent(journal, respondent)
    if isinstance(reader, LiveReader):
        reader = ReplayedReader(journal, reader)
    lap = LapParts(driver, demonstrator, parts.lap.model)
    return replace(parts, lap=lap, respondent=respondent, reader=reader)
