"""Can the tests be trusted? Draws cohorts at table level and counts the tests' results.

    python bench/trust_in_tests.py [--cohorts 1000] [--seed 0]

Prints a Markdown table: how often each test rejects a true null hypothesis at 5% (size), how often
each interval of 95% holds the true value (coverage), and how often a known effect is found (power).
The table in docs/analysis.md is its output.
"""

import argparse
import math
from collections.abc import Callable

import numpy as np
import pandas as pd

from analysis.stats.cronbach_alpha import cronbach_alpha
from analysis.stats.effect_size import cohen_dz, rank_biserial
from analysis.stats.holm import holm
from analysis.stats.kolmogorov_smirnov import two_sample_ks
from analysis.stats.map_overlap import map_overlap
from analysis.stats.mean_difference import mean_difference
from analysis.stats.mixed_model import lap_time_model
from analysis.stats.own_contrasts import own_contrasts
from analysis.stats.permutation import sign_flip
from analysis.stats.proportional_odds import log_odds_ratios, proportional_odds
from analysis.stats.ratio import mean_of_ratios, ratio_of_means
from analysis.stats.result import TestResult
from analysis.stats.signed_rank import signed_rank
from analysis.stats.tost import paired_tost

N = 12
BETWEEN, WITHIN = 0.3, 0.12  # sd of log lap times between people, and from lap to lap
EFFECT = -0.12  # log ratio: 11% faster
MARGIN = 5.0
TRUE_ALPHA = 4 / 3 * (1 - 4 * 2 / (16 + 4))  # of ``scale``: four items of variance 2, covariance 1
CUTS = np.array([-2.0, -0.7, 0.5, 1.8])

Rng = np.random.Generator


def pairs(rng: Rng, effect: float, n: int = N) -> tuple[np.ndarray, np.ndarray]:
    """Return lap times of n people in a reference and a condition, s."""
    person = rng.normal(4.2, BETWEEN, n)
    times = person + rng.normal(0, WITHIN, (2, n)) + np.array([[0.0], [effect]])
    return tuple(np.exp(times))


def laps(rng: Rng, effect: float) -> pd.DataFrame:
    """Return lap times of a cohort in four conditions; the last one has the effect."""
    person = rng.normal(4.2, BETWEEN, N)
    rows = [
        (f"P{i}", f"c{c}", c, math.exp(person[i] + effect * (c == 3) + rng.normal(0, WITHIN)))
        for i in range(N)
        for c in range(4)
    ]
    return pd.DataFrame(rows, columns=["participant", "condition", "place", "lap_time_s"])


def unequal_laps(rng: Rng, effect: float) -> pd.DataFrame:
    """Return lap times of a cohort whose contrasts spread unequally, as in the cohort.

    The limited lap (c1) differs from a person's other laps by person; the two assisted laps (c2,
    c3) are driven nearly alike. Standard deviations of log differences: about 0.17 and 0.02.
    """
    person = rng.normal(4.2, BETWEEN, N)
    limited = rng.normal(0, 0.16, N)
    assisted = rng.normal(0, 0.05, N)
    spread = {0: 0.05, 1: 0.05, 2: 0.015, 3: 0.015}
    rows = []
    for i in range(N):
        for c in range(4):
            log_time = person[i] + limited[i] * (c == 1) + assisted[i] * (c > 1)
            noise = rng.normal(0, spread[c]) + effect * (c == 3)
            rows.append((f"P{i}", f"c{c}", c, math.exp(log_time + noise)))
    return pd.DataFrame(rows, columns=["participant", "condition", "place", "lap_time_s"])


def answers(rng: Rng, effect: float, n: int = N) -> tuple[np.ndarray, np.ndarray]:
    """Return answers of n people on five points after a reference and a condition."""
    person = rng.normal(0, 1, n)
    latent = person + rng.logistic(size=(2, n)) + np.array([[0.0], [effect]])
    return tuple(1 + np.digitize(latent, CUTS))


def maps(rng: Rng, shift: float) -> tuple[np.ndarray, np.ndarray]:
    """Return counts over 80 cells of two sources that help N people around one place."""
    at = np.arange(80)
    centre = 40 + rng.normal(0, 2, (2, N, 1)) + np.array([0.0, shift])[:, None, None]
    return tuple(30 * np.exp(-0.5 * ((at - centre) / 5) ** 2))


def scale(rng: Rng) -> pd.DataFrame:
    """Return answers of N people to four items that measure one thing, each with its own error."""
    person = rng.normal(0, 1, (N, 1))
    return pd.DataFrame(person + rng.normal(0, 1, (N, 4)), columns=list("abcd"))


def families(rng: Rng) -> float:
    """Return the smallest Holm-corrected p of a family of three true null hypotheses."""
    reference = pairs(rng, 0.0)[0]
    noise = rng.normal(0, WITHIN, (3, N))
    return min(holm([signed_rank(d).p for d in reference * noise]))


TESTS: dict[str, tuple[Callable[[Rng], float], Callable[[Rng], float] | None]] = {
    "Wilcoxon signed-rank, lap times": (
        lambda r: signed_rank(np.subtract(*pairs(r, 0.0))).p,
        lambda r: signed_rank(np.subtract(*pairs(r, EFFECT))).p,
    ),
    "paired t": (
        lambda r: mean_difference(np.subtract(*pairs(r, 0.0))).p,
        lambda r: mean_difference(np.subtract(*pairs(r, EFFECT))).p,
    ),
    "sign flips": (
        lambda r: sign_flip(np.subtract(*pairs(r, 0.0)), r).p,
        lambda r: sign_flip(np.subtract(*pairs(r, EFFECT)), r).p,
    ),
    "mixed model, one contrast of three": (
        lambda r: lap_time_model(laps(r, 0.0), "c1", r)[-1].p,
        lambda r: lap_time_model(laps(r, EFFECT), "c1", r)[-1].p,
    ),
    "the same, contrasts of unequal spread": (
        lambda r: lap_time_model(unequal_laps(r, 0.0), "c1", r)[-1].p,
        lambda r: lap_time_model(unequal_laps(r, EFFECT), "c1", r)[-1].p,
    ),
    "own contrasts, equal spread": (
        lambda r: own_contrasts(laps(r, 0.0), "c1")[-1].p,
        lambda r: own_contrasts(laps(r, EFFECT), "c1")[-1].p,
    ),
    "own contrasts, unequal spread": (
        lambda r: own_contrasts(unequal_laps(r, 0.0), "c1")[-1].p,
        lambda r: own_contrasts(unequal_laps(r, EFFECT), "c1")[-1].p,
    ),
    "Holm, any of three (family-wise)": (families, None),
    "Wilcoxon signed-rank, a Likert item": (
        lambda r: signed_rank(np.subtract(*answers(r, 0.0)).astype(float)).p,
        lambda r: signed_rank(np.subtract(*answers(r, 1.5)).astype(float)).p,
    ),
    "TOST, true difference at the margin": (
        lambda r: paired_tost(r.normal(MARGIN, 8, N), MARGIN).p,
        lambda r: paired_tost(r.normal(0, 8, N), MARGIN).p,
    ),
    "map overlap": (
        lambda r: map_overlap(*maps(r, 0.0), r).p,
        lambda r: map_overlap(*maps(r, 3.0), r).p,
    ),
    "Kolmogorov-Smirnov on the same people (descriptive)": (
        lambda r: two_sample_ks(*pairs(r, 0.0), same_people=True).p,
        lambda r: two_sample_ks(*pairs(r, EFFECT), same_people=True).p,
    ),
}


def intervals() -> dict[str, tuple[Callable[[Rng], TestResult], float]]:
    """Return each interval with the true value it should hold."""
    crowd = np.random.default_rng(1)
    reference, condition = pairs(crowd, EFFECT, 4_000_000)
    skewed = condition - reference
    a, b = answers(crowd, 1.5, 2_000_000)
    table = np.array([[[(x == i).sum() for i in range(1, 6)] for x in (a, b)]], dtype=float)
    walsh = (skewed[: len(skewed) // 2] + skewed[len(skewed) // 2 :]) / 2
    return {
        "mean difference, t": (
            lambda r: mean_difference(-np.subtract(*pairs(r, EFFECT))), float(skewed.mean())),
        "pseudomedian, inverted Wilcoxon": (
            lambda r: signed_rank(-np.subtract(*pairs(r, EFFECT))), float(np.median(walsh))),
        "d_z, BCa": (
            lambda r: cohen_dz(-np.subtract(*pairs(r, EFFECT)), r),
            float(skewed.mean() / skewed.std())),
        "rank-biserial, BCa": (
            lambda r: rank_biserial(-np.subtract(*pairs(r, EFFECT)), r),
            float(2 * (walsh > 0).mean() - 1)),
        "ratio of means, Fieller": (
            lambda r: ratio_of_means(*pairs(r, EFFECT)),
            float(reference.mean() / condition.mean())),
        "mean of ratios, t": (
            lambda r: mean_of_ratios(*pairs(r, EFFECT)), float((reference / condition).mean())),
        "mixed model, t": (lambda r: lap_time_model(laps(r, EFFECT), "c1", r)[-1], EFFECT),
        "the same, contrasts of unequal spread": (
            lambda r: lap_time_model(unequal_laps(r, EFFECT), "c1", r)[-1], EFFECT),
        "own contrasts, unequal spread": (
            lambda r: own_contrasts(unequal_laps(r, EFFECT), "c1")[-1], EFFECT),
        "TOST, 90%": (lambda r: paired_tost(r.normal(2.0, 8, N), MARGIN), 2.0),
        "Cronbach's alpha, Feldt": (lambda r: cronbach_alpha(scale(r)), TRUE_ALPHA),
        "odds ratio, percentile": (
            lambda r: proportional_odds(*answers(r, 1.5)[::-1], r),
            float(log_odds_ratios(table)[0])),
    }  # fmt: skip


def main() -> None:
    """Draw, count, print."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--cohorts", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    m = options.cohorts
    error = 1.96 * math.sqrt(0.05 * 0.95 / m)
    print(f"{m} cohorts of {N}; 5% has a binomial error of {100 * error:.1f} percentage points.\n")
    print("| test | size at 5% | power |\n|---|---|---|")
    for name, (null, effect) in TESTS.items():
        rng = np.random.default_rng([options.seed, 1])
        size = np.mean([null(rng) <= 0.05 for _ in range(m)])
        power = np.mean([effect(rng) <= 0.05 for _ in range(m)]) if effect else math.nan
        print(f"| {name} | {100 * size:.1f}% | {'–' if not effect else f'{100 * power:.0f}%'} |",
              flush=True)  # fmt: skip
    print("\n| interval of 95% (TOST: 90%) | coverage | without interval |\n|---|---|---|")
    for name, (estimate, truth) in intervals().items():
        rng = np.random.default_rng([options.seed, 2])
        found = [estimate(rng) for _ in range(m)]
        there = [f for f in found if not math.isnan(f.low)]
        covered = np.mean([f.low <= truth <= f.high for f in there])
        print(f"| {name} | {100 * covered:.1f}% | {100 * (1 - len(there) / m):.1f}% |", flush=True)


if __name__ == "__main__":
    main()
