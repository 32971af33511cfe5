"""Contacts with obstacles."""

import numpy as np

from analysis.measures.episodes import episodes
from analysis.measures.streams import Steps, period, stream


def collisions(steps: Steps) -> float:
    """Return the number of unbroken contacts with obstacles."""
    contact = stream(steps, "contact")
    if len(contact) == 0 or np.isnan(contact).any():
        return float("nan")
    return float(len(episodes(contact > 0)))


def contact_time(steps: Steps) -> float:
    """Return the time in contact with obstacles, in s."""
    return float(stream(steps, "contact").sum() * period(steps))
