"""Which laps a participant drives, in which order: the one place that says so."""

from protocols.laps import PlannedLap
from protocols.study import StudyProtocol


def laps_of(protocol: StudyProtocol, number: int, seed: int) -> tuple[PlannedLap, ...]:  # noqa: ARG001
    """Return a participant's laps in the order in which they are driven.

    A function of protocol, participant and seed alone: it does not depend on who else takes part.

    Parameters
    ----------
    protocol
        The study; every protocol has one order now.
    number
        The participant, counted from 1.
    seed
        The study's seed, 0 or more.

    Examples
    --------
    >>> from protocols.load import load_protocol
    >>> [lap.condition for lap in laps_of(load_protocol("four-lap"), 1, 0)][:2]
    ['familiarisation', 'baseline']
    """
    return protocol.laps
