"""Whether the model knew when to help: its p(h) against the shadow demonstrator's h."""

import numpy as np

from analysis.measures.streams import Flags, Numbers, Steps, stream


def when_auc(steps: Steps) -> float:
    """Return the area under the ROC curve of p(h = 1 | x) against the shadow demonstrator.

    Predictions are recorded before the model learns from a step, so they are out of sample.

    Returns
    -------
    float
        0 to 1, 0.5 by chance; NaN when the demonstrator would always or never have helped, or
        there was no model.
    """
    p, h = predictions(steps)
    if not h.any() or h.all():
        return float("nan")
    return area_under_roc(p, h)


def brier_score(steps: Steps) -> float:
    """Return the mean squared error of p(h = 1 | x) as a probability, 0 (best) to 1.

    References
    ----------
    Brier (1950), Monthly Weather Review 78(1), 1-3.
    """
    p, h = predictions(steps)
    return float(((p - h) ** 2).mean()) if len(p) else float("nan")


def predictions(steps: Steps) -> tuple[Numbers, Flags]:
    """Return p(h = 1 | x) and whether the demonstrator would help, where both are known."""
    p, h = stream(steps, "p_help"), stream(steps, "h_would")
    known = ~np.isnan(p) & ~np.isnan(h)
    return p[known], np.asarray(h[known] > 0)


def area_under_roc(scores: Numbers, positive: Flags) -> float:
    """Return the chance that a positive case scores above a negative one, ties counting half.

    Both kinds have to be there, and no score may be missing.

    Examples
    --------
    >>> import numpy as np
    >>> area_under_roc(np.array([0.1, 0.4, 0.35, 0.8]), np.array([False, False, True, True]))
    0.75
    """
    cases, others = scores[positive], np.sort(scores[~positive])
    above, at_least = (np.searchsorted(others, cases, side).sum() for side in ("left", "right"))
    return float((above + at_least) / 2 / (len(cases) * len(others)))
