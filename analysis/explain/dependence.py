"""Which inputs when-to-help and how-to-help depend on: answers with one of them mixed up."""

from collections.abc import Mapping

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from analysis.explain.recorded import Looked, answers
from analysis.stats.mean_difference import mean_difference
from lad.lad_assistant import LADAssistant

Floats = NDArray[np.float64]

INPUTS: Mapping[str, slice | list[int]] = {
    "how far the user pushes forwards": [0],
    "how far the user pushes to the side": [1],
    "how fast the chair drives": [2],
    "how fast the chair turns": [3],
    "room on the right": slice(4, 9),
    "room ahead": slice(9, 14),
    "room on the left": slice(14, 19),
}
"""Groups of the 19 inputs, in words; laser segments go from right to left."""

PAST = "what was seen in the last steps"
REPEATS = 10
MOST_STEPS = 200


def dependence(
    model: LADAssistant,
    looked: Looked,
    rng: np.random.Generator,
    repeats: int = REPEATS,
    most: int = MOST_STEPS,
) -> pd.DataFrame:
    """Return how much answers change when one group of inputs is another step's.

    Permutation importance (Breiman, 2001) of the policy itself: no label is needed, and other
    inputs stay as they were. Inputs that go together, such as a command and the velocity that
    follows, share their importance.

    Parameters
    ----------
    model
        Taught.
    looked
        Steps to ask it about.
    rng
        For the permutations.
    repeats
        Permutations of each group, 2 or more.
    most
        So many of the steps, evenly spread, are used.

    Returns
    -------
    DataFrame
        ``input``; ``when``, the mean absolute change of p(h), and ``how``, that of the turn rate
        in rad/s where the model would help; ``when_low`` to ``how_high``, their 95% intervals over
        permutations; ``lengthscales``, the spread of the inputs in units of the regressor's
        lengthscales: below 1 the kernel hardly tells them apart.
    """
    chosen = np.linspace(0, len(looked.windows) - 1, min(most, len(looked.windows)))
    windows = looked.windows[chosen.round().astype(int)]
    p, commands = answers(model, windows)
    rows = []
    for name, group in {**INPUTS, PAST: slice(None)}.items():
        changes = []
        for _ in range(repeats):
            mixed = _mixed(windows, group, rng.permutation(len(windows)), past=name == PAST)
            other_p, other = answers(model, mixed)
            helping = p >= model.parameters.threshold
            turned = np.abs(other - commands)[helping, 1]
            changes.append((np.abs(other_p - p).mean(), turned.mean() if len(turned) else np.nan))
        rows.append({"input": name, **_summary(np.array(changes)), **_spread(model, windows, name)})
    return pd.DataFrame(rows)


def _mixed(
    windows: Floats, group: slice | list[int], order: NDArray[np.int64], *, past: bool
) -> Floats:
    """Give every step another one's group of inputs, over the whole window or its past only."""
    mixed = windows.copy()
    if past:
        mixed[:, 1:] = windows[order][:, 1:]
    else:
        mixed[:, :, group] = windows[order][:, :, group]
    return mixed


def _summary(changes: Floats) -> dict[str, float]:
    found: dict[str, float] = {}
    for i, name in enumerate(("when", "how")):
        result = mean_difference(changes[:, i].tolist())
        found |= {name: result.estimate, f"{name}_low": result.low, f"{name}_high": result.high}
    return found


def _spread(model: LADAssistant, windows: Floats, name: str) -> dict[str, float]:
    if name == PAST:
        return {"lengthscales": float("nan")}
    group = INPUTS[name]
    sizes = np.array(model.how.hyperparameters.lengthscales)[group]
    return {"lengthscales": float((windows[:, 0, group].std(axis=0) / sizes).mean())}
