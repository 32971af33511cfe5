"""How close the chair came to an obstacle."""

import numpy as np

from analysis.measures.streams import Steps, stream


def minimum_clearance(steps: Steps) -> float:
    """Return the smallest distance between the chair's footprint and an obstacle, in m."""
    clearance = stream(steps, "clearance_m")
    clearance = clearance[~np.isnan(clearance)]
    return float(clearance.min()) if len(clearance) else float("nan")
