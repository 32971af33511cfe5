"""How much help there was, and in how many pieces."""

from analysis.measures.streams import Steps, helped, period, stretches_of_help


def assisted_fraction(steps: Steps) -> float:
    """Return the share of steps in which an assistant's command counted, 0 to 1."""
    on = helped(steps)
    return float("nan") if on is None else float(on.mean())


def interventions(steps: Steps) -> float:
    """Return the number of unbroken stretches of assistance."""
    stretches = stretches_of_help(steps)
    return float("nan") if stretches is None else float(len(stretches))


def intervention_duration(steps: Steps) -> float:
    """Return the mean duration of an intervention, in s; NaN without one."""
    stretches = stretches_of_help(steps)
    if not stretches:
        return float("nan")
    return sum(e.stop - e.start for e in stretches) * period(steps) / len(stretches)
