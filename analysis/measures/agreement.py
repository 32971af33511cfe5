"""Whether user and assistant wanted the same movement."""

import numpy as np
import pyarrow.compute as pc

from analysis.measures.streams import Numbers, Steps, command, helped, once_per_lap


def agreement(steps: Steps) -> float:
    """Return the mean cosine between the user's and the assistant's command while assisted.

    Commands count in shares of full deflection; the user's is the intent before the limitation.
    Steps in which either asks for nothing have no direction and are left out.

    Returns
    -------
    float
        -1 (opposite) to 1 (same direction); NaN without assistance.
    """
    cosines = _cosines(steps)
    return float(cosines.mean()) if len(cosines) else float("nan")


def opposition(steps: Steps) -> float:
    """Return the share of assisted steps in which user and assistant disagreed, 0 to 1.

    They disagree when the angle between the two commands is above 90 degrees.
    """
    cosines = _cosines(steps)
    return float((cosines < 0).mean()) if len(cosines) else float("nan")


@once_per_lap
def _cosines(steps: Steps) -> Numbers:
    on = helped(steps)
    if on is None:
        return np.empty(0)
    user, assistant = command(steps, "intent"), _assistant(steps)
    sizes = np.linalg.norm(user, axis=1) * np.linalg.norm(assistant, axis=1)
    used = on & (sizes > 0)  # NaN is not above 0
    return np.asarray((user * assistant).sum(axis=1)[used] / sizes[used])


def _assistant(steps: Steps) -> Numbers:
    """Return whether the demonstrator's or the model's command helped."""
    by_model = pc.equal(steps.columns["control"], "model").to_numpy()[:, None]
    return np.where(by_model, command(steps, "mean"), command(steps, "a"))
