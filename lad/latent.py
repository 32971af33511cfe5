"""When was help given, if no signal says so? A two-state Markov chain on what help changed.

The first open question of Soh & Demiris: "How can we train the model efficiently when the assistive
signal is latent?" What is seen is the user's command u and the command c that counted. Without
help c - u is noise around zero; with help it is something else, and help comes in stretches.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lad.errors import InvalidTargetError, TooFewStepsError

Floats = NDArray[np.float64]

LEAST_STEPS = 20
LEAST_VARIANCE = 1e-8
"""(m/s)^2, (rad/s)^2: where nothing else differs, rounding does."""

MOST_ROUNDS, CLOSE = 200, 1e-6
FAR = (3.0, 2.0, 1.5)
"""First guesses: help is where the difference is farther out than this many robust sds."""


@dataclass(frozen=True)
class Inferred:
    """What the chain found.

    Attributes
    ----------
    p_help
        Shape (n,): p(h = +1) of each step, given all steps.
    stay
        Probability that no help, and help, goes on for a step.
    noise_sd
        Standard deviation of c - u without help, in both components.
    correction
        Mean of c - u with help.
    """

    p_help: Floats
    stay: tuple[float, float]
    noise_sd: tuple[float, float]
    correction: tuple[float, float]


def infer_help(differences: Floats) -> Inferred:
    """Infer in which steps help was given.

    Expectation maximisation (Baum, Petrie, Soules & Weiss, 1970) of a hidden Markov chain with
    emissions N(0, diag(s^2)) without help and N(m, S) with it. Where two states explain the steps
    no better than noise alone, by the Bayesian information criterion, no help is found.

    Parameters
    ----------
    differences
        Shape (n, 2): the command that counted minus the user's, of consecutive steps.

    Raises
    ------
    TooFewStepsError
        When there are fewer than 20 steps.
    InvalidTargetError
        When the shape is another, or a value is not finite.

    Examples
    --------
    >>> rng = np.random.default_rng(0)
    >>> d = rng.normal(0.0, 0.05, (90, 2))
    >>> d[40:60] += -0.1, -0.35
    >>> np.flatnonzero(infer_help(d).p_help > 0.5)[[0, -1]].tolist()
    [40, 59]
    """
    d = np.asarray(differences, dtype=np.float64)
    if d.ndim != 2 or d.shape[1] != 2 or not np.isfinite(d).all():
        raise InvalidTargetError(f"differences: given shape {d.shape}; allowed is (n, 2), finite")
    if len(d) < LEAST_STEPS:
        raise TooFewStepsError(f"differences: given {len(d)} steps; allowed are {LEAST_STEPS} up")
    scale = np.maximum(np.median(np.abs(d), axis=0) / 0.6745, LEAST_VARIANCE**0.5)
    out = np.square(d / scale).sum(axis=1)
    fits = [_fitted(d, (out > far**2).astype(np.float64)) for far in FAR]
    # The other way round, with the noise in the state of help, is a local optimum too.
    right = [f for f in fits if f is not None and _help_is_larger(d, f[0])]
    p, stay, evidence = max(right, key=lambda fit: fit[2], default=(None, None, -np.inf))
    without = _log_normal(d, np.zeros(2), np.diag(_square(d))).sum()
    if p is None or stay is None or evidence - without < 4.0 * np.log(len(d)):
        return _noise_alone(d)
    noise = np.sqrt(_weighted_square(d, 1.0 - p))
    return Inferred(p, _pair(stay), _pair(noise), _pair(p @ d / p.sum()))


def _fitted(d: Floats, p: Floats) -> tuple[Floats, Floats, float] | None:
    """Return p(h = +1), the probabilities to stay and the log evidence from a first guess of p."""
    stay, before, evidence = np.array([0.95, 0.95]), -np.inf, -np.inf
    for _ in range(MOST_ROUNDS):
        if not 1e-6 < p.mean() < 1.0 - 1e-6:
            return None
        p, stay, evidence = _smoothed(_emissions(d, p), stay, float(np.clip(p[0], 0.01, 0.99)))
        if evidence - before < CLOSE:
            break
        before = evidence
    return p, stay, evidence


def _help_is_larger(d: Floats, p: Floats) -> bool:
    scale = _square(d)
    with_help, without = _weighted_square(d, p), _weighted_square(d, 1.0 - p)
    return bool((with_help / scale).sum() > (without / scale).sum())


def _pair(values: Floats) -> tuple[float, float]:
    return float(values[0]), float(values[1])


def _noise_alone(d: Floats) -> Inferred:
    return Inferred(np.zeros(len(d)), (1.0, 0.0), _pair(np.sqrt(_square(d))), (0.0, 0.0))


def _square(d: Floats) -> Floats:
    squares: Floats = np.maximum(np.square(d).mean(axis=0), LEAST_VARIANCE)
    return squares


def _weighted_square(d: Floats, weight: Floats) -> Floats:
    squares: Floats = np.maximum(weight @ np.square(d) / max(weight.sum(), 1e-9), LEAST_VARIANCE)
    return squares


def _emissions(d: Floats, p: Floats) -> Floats:
    """Return log densities, shape (n, 2), with the parameters that the weights p ask for."""
    mean = p @ d / max(p.sum(), 1e-9)
    off = d - mean
    spread = (p * off.T) @ off / max(p.sum(), 1e-9) + LEAST_VARIANCE * np.eye(2)
    without = _log_normal(d, np.zeros(2), np.diag(_weighted_square(d, 1.0 - p)))
    return np.column_stack([without, _log_normal(d, mean, spread)])


def _log_normal(d: Floats, mean: Floats, covariance: Floats) -> Floats:
    off = d - mean
    solved = np.linalg.solve(covariance, off.T).T
    _, log_det = np.linalg.slogdet(covariance)
    return np.asarray(-0.5 * (off * solved).sum(axis=1) - 0.5 * log_det - np.log(2.0 * np.pi))


def _smoothed(log_emission: Floats, stay: Floats, first: float) -> tuple[Floats, Floats, float]:
    """Return p(h = +1) given all steps, the next probabilities to stay, and the log evidence.

    Scaled forwards and backwards passes (Rabiner, 1989, section V.A), on plain numbers: two states
    are too few for arrays to pay.
    """
    largest = log_emission.max(axis=1)
    emission = np.exp(log_emission - largest[:, None]).tolist()
    s0, s1 = float(stay[0]), float(stay[1])
    forwards, scales = _forwards(emission, s0, s1, first)
    b0 = b1 = 1.0
    p, moves = [0.0] * len(emission), [[0.0, 0.0], [0.0, 0.0]]
    p[-1] = forwards[-1][1]
    for t in range(len(emission) - 2, -1, -1):
        (e0, e1), scale, (f0, f1) = emission[t + 1], scales[t + 1], forwards[t]
        w0, w1 = e0 * b0 / scale, e1 * b1 / scale
        moves[0][0] += f0 * s0 * w0
        moves[0][1] += f0 * (1.0 - s0) * w1
        moves[1][0] += f1 * (1.0 - s1) * w0
        moves[1][1] += f1 * s1 * w1
        b0, b1 = s0 * w0 + (1.0 - s0) * w1, (1.0 - s1) * w0 + s1 * w1
        p[t] = f1 * b1
    counts = np.array(moves)
    kept = np.diag(counts) / np.maximum(counts.sum(axis=1), 1e-12)
    evidence = float(np.log(scales).sum() + largest.sum())
    return np.array(p), np.clip(kept, 0.01, 0.9999), evidence


def _forwards(
    emission: list[list[float]], s0: float, s1: float, first: float
) -> tuple[list[tuple[float, float]], list[float]]:
    forwards, scales = [], []
    a0, a1 = 1.0 - first, first
    for e0, e1 in emission:
        a0, a1 = a0 * e0, a1 * e1
        scale = max(a0 + a1, 1e-300)
        a0, a1 = a0 / scale, a1 / scale
        forwards.append((a0, a1))
        scales.append(scale)
        a0, a1 = a0 * s0 + a1 * (1.0 - s1), a0 * (1.0 - s0) + a1 * s1
    return forwards, scales
