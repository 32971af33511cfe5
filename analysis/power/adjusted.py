"""What the declared analyses compare, of many drawn studies at once: places' effects taken off."""

import numpy as np
from numpy.typing import NDArray

from analysis.place import restored
from analysis.power.pool import Array, Pool
from protocols.declared import Comparison


def adjusted(pool: Pool, drawn: NDArray[np.intp]) -> Array:
    """Return log times of drawn studies less each place's effect, where a study identifies it.

    Returns
    -------
    NDArray
        Shape (studies, n, conditions).
    """
    logs, places = pool.log_times[drawn], pool.places[drawn]
    levels = np.unique(places[np.isfinite(places)])
    if len(np.unique(pool.orders)) < 2 or len(levels) < 2:
        return logs
    found = logs.copy()
    for study in range(len(logs)):
        found[study] -= _place_effects(logs[study], places[study], levels)
    return found


def _place_effects(logs: Array, places: Array, levels: Array) -> Array:
    """Return each lap's place effect by least squares beside people and conditions; else zeros."""
    there = np.isfinite(logs)
    n, k = logs.shape
    columns = [np.broadcast_to(np.eye(k)[c], (n, k)) for c in range(1, k)]
    place_columns = [(places == level).astype(float) for level in levels[1:]]
    stack = np.stack([*columns, *place_columns], axis=-1) * there[..., None]
    count = np.maximum(there.sum(axis=1), 1)[:, None, None]
    within = (stack - stack.sum(axis=1, keepdims=True) / count) * there[..., None]
    y = np.where(there, logs, 0.0)
    y = (y - y.sum(axis=1, keepdims=True) / count[..., 0]) * there
    x, target = within.reshape(n * k, -1), y.reshape(-1)
    if np.linalg.matrix_rank(x) < x.shape[1]:
        return np.zeros_like(logs)
    effects = np.linalg.lstsq(x, target, rcond=None)[0][k - 1 :]
    taken: Array = sum(
        (e * c for e, c in zip(effects, place_columns, strict=True)), np.zeros_like(logs)
    )
    return taken


def log_differences(
    pool: Pool, drawn: NDArray[np.intp], logs: Array, analysis: Comparison
) -> Array:
    """Return log ratios of condition and reference of drawn studies, as a report tests them.

    Parameters
    ----------
    pool, drawn
        The studies.
    logs
        As ``adjusted`` returns them; NaN for those who are lost.
    analysis
        A comparison within participants.
    """
    differences = log_values(pool, logs, analysis)
    if len(np.unique(pool.orders)) < 2:
        return differences
    pair, places = list(pool.columns(analysis)), pool.places[drawn]
    both = np.isfinite(logs[..., pair]).all(axis=2)
    levels = np.unique(places[np.isfinite(places)])
    counts = [((places[..., c] == level) & both).sum(axis=1) for c in pair for level in levels]
    uneven = np.any(np.array(counts[: len(levels)]) != np.array(counts[len(levels) :]), axis=0)
    timed = np.isfinite(logs)
    within = timed.sum(axis=(1, 2)) - timed.any(axis=2).sum(axis=1) - (logs.shape[2] - 1)
    return np.where(uneven[:, None], restored(differences, within, len(levels) - 1), differences)


def log_values(pool: Pool, logs: Array, analysis: Comparison) -> Array:
    """Return log ratios of condition and reference; without a reference, the condition's logs."""
    condition, *reference = pool.columns(analysis)
    return np.asarray(logs[..., condition] - sum(logs[..., at] for at in reference))


def people_values(pool: Pool, logs: Array, analysis: Comparison, drawn: NDArray[np.intp]) -> Array:
    """Return what a comparison of groups compares, of people drawn: studies by people."""
    if analysis.outcome != "lap_time_s":
        return pool.differences[analysis.name][drawn]
    # A condition's own times keep the places' effects: groups have the same places.
    return log_values(pool, logs if analysis.reference else pool.log_times[drawn], analysis)
