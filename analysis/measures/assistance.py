"""How much help there was, and in how many pieces."""

from analysis.measures.episodes import episodes
from analysis.measures.streams import Steps, helped, period


def assisted_fraction(steps: Steps) -> float:
    """Return the share of steps in which an assistant's command counted, 0 to 1."""
    on = helped(steps)
    return float("nan") if on is None else float(on.mean())


def interventions(steps: Steps) -> float:
    """Return the number of unbroken stretches of assistance."""
    on = helped(steps)
    return float("nan") if on is None else float(len(episodes(on)))


def intervention_duration(steps: Steps) -> float:
    """Return the mean duration of an intervention, in s; NaN without one."""
    on = helped(steps)
    stretches = [] if on is None else episodes(on)
    if not stretches:
        return float("nan")
    return sum(e.stop - e.start for e in stretches) * period(steps) / len(stretches)
