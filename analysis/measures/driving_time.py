"""How long the lap was driven."""

from analysis.measures.streams import Steps, period, stream


def driving_time(steps: Steps) -> float:
    """Return the time from the first step's start to the last step's end, in s.

    A finished lap's ``lap_time_s`` is up to one step shorter: it ends on the finish line.
    """
    return float(stream(steps, "t_s")[-1] + period(steps)) if len(steps) > 1 else float("nan")
