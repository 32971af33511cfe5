"""When help came, measured against what the shadow demonstrator would have done."""

import math

from analysis.measures.episodes import Episode, episodes
from analysis.measures.streams import (
    Steps,
    helped,
    once_per_lap,
    period,
    stretches_of_help,
    would_help,
)

EARLIEST = 3.0
"""Help that ended earlier than this before the demonstrator's onset has another cause, s."""


def onset_lead(steps: Steps) -> float:
    """Return the mean lead of assistance over the shadow demonstrator's onsets, in s.

    Positive: help began earlier than the demonstrator's would have. Onsets without help are left
    out (``missed_onsets`` counts them).

    Returns
    -------
    float
        NaN when no onset was helped.
    """
    leads = [lead for lead in _leads(steps) if lead is not None]
    return sum(leads) / len(leads) if leads else float("nan")


def missed_onsets(steps: Steps) -> float:
    """Return the share of the shadow demonstrator's interventions in which no help came, 0 to 1.

    Returns
    -------
    float
        NaN when the demonstrator would never have helped, or the times are unknown.
    """
    leads = _leads(steps)
    return sum(lead is None for lead in leads) / len(leads) if leads else float("nan")


def needless_time(steps: Steps) -> float:
    """Return how long help was given that the shadow demonstrator would not have given, in s."""
    on, wanted = helped(steps), would_help(steps)
    if on is None or wanted is None:
        return float("nan")
    return float((on & ~wanted).sum() * period(steps))


@once_per_lap
def _leads(steps: Steps) -> list[float | None]:
    """Return the lead at each of the demonstrator's onsets; None where no help came."""
    given, wanted, dt = stretches_of_help(steps), would_help(steps), period(steps)
    if given is None or wanted is None or math.isnan(dt):
        return []
    onsets = episodes(wanted)
    matches = [_first_help(given, onset, EARLIEST / dt) for onset in onsets]
    return [
        None if match is None else (onset.start - match.start) * dt
        for onset, match in zip(onsets, matches, strict=True)
    ]


def _first_help(given: list[Episode], onset: Episode, reach: float) -> Episode | None:
    for episode in given:
        if episode.stop > onset.start - reach and episode.start < onset.stop:
            return episode
    return None
