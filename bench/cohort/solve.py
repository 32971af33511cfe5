"""Solve a cell: the medians and spreads of the calibrated traits that give the four figures."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from cohort.emulator import LapTime, draw_columns
from cohort.grid import CALIBRATED, TARGETS, Cell, population
from numpy.typing import NDArray
from scipy import optimize, stats

from participants.human.patience import THINKING_IT_OVER
from participants.population import TRAITS, Marginal

PEOPLE_DRAWN = 4096
"""How many people a population is judged by; Sobol points, the same ones for every population."""

TIME_LIMIT = 300.0
"""The shipped protocol's, s."""

BOUNDS = ((-7.0, np.log(0.5), -6.0, np.log(0.5)), (0.0, np.log(3.0), 0.0, np.log(3.0)))
"""Medians on the logit scale of the trait's range, logarithms of spreads."""

START = (-3.0, 0.3, -3.4, 0.35)


@dataclass(frozen=True)
class Crowd:
    """What people are drawn from: latent traits, luck of each lap, and how long they think."""

    people: int = PEOPLE_DRAWN
    seed: int = 0

    @cached_property
    def draws(self) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
        """Latent traits (people, traits), laps' luck (people, 2), seconds of thinking (people, 2).

        Those of the first two are standard normal.
        """
        n = len(TRAITS)
        points = stats.qmc.Sobol(n + 4, rng=np.random.default_rng(self.seed)).random(self.people)
        points = np.clip(points, 1e-9, 1 - 1e-9)
        normal = stats.norm.ppf(points[:, : n + 2])
        return normal[:, :n], normal[:, n:], -THINKING_IT_OVER * np.log(points[:, n + 2 :])


def expected(
    cell: Cell, solved: Mapping[str, Marginal], laps: tuple[LapTime, LapTime], crowd: Crowd
) -> NDArray[np.float64]:
    """Return what a population would show: means and sds in the order of ``TARGETS``, s.

    Unfinished laps, out of time or given up, are left out as they would be of a table.
    """
    latent, luck, thinking = crowd.draws
    columns = draw_columns(population(cell, solved), latent)
    figures = []
    for i, lap in enumerate(laps):
        seconds = np.exp(lap.log_seconds(columns) + lap.noise * luck[:, i])
        end = np.minimum(TIME_LIMIT, columns["patience_s"] + thinking[:, i])
        done = seconds[seconds < end]
        figures += [done.mean(), done.std(ddof=1)]
    return np.array(figures)


def marginals(unknowns: NDArray[np.float64]) -> dict[str, Marginal]:
    """Return the calibrated traits' distributions from the four unknowns."""
    found = {}
    for i, name in enumerate(CALIBRATED):
        trait, logit = TRAITS[name], unknowns[2 * i]
        median = trait.low + (trait.high - trait.low) / (1.0 + np.exp(-logit))
        found[name] = Marginal(
            round(float(median), 4), round(float(np.exp(unknowns[2 * i + 1])), 4)
        )
    return found


def solve(cell: Cell, laps: tuple[LapTime, LapTime], crowd: Crowd) -> dict[str, Marginal]:
    """Return the calibrated traits' distributions for a cell.

    Parameters
    ----------
    cell
        Medians of the free traits.
    laps
        What has been learnt about baseline and limited laps.
    crowd
        Who judges.
    """
    goal = np.array(list(TARGETS.values()))

    def miss(unknowns: NDArray[np.float64]) -> NDArray[np.float64]:
        found = expected(cell, marginals(unknowns), laps, crowd)
        return np.asarray(found / goal - 1.0) * np.array([1.0, 0.5, 1.0, 0.5])

    best = optimize.least_squares(
        miss, START, bounds=BOUNDS, diff_step=0.03, xtol=1e-4, ftol=1e-6, max_nfev=15
    )
    return marginals(best.x)
