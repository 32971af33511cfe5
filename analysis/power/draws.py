"""Studies drawn from a pool of people, and the pool's own error."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from analysis.power.pool import Pool


def draw_studies(
    pool: Pool, wanted: Sequence[tuple[str, str]], studies: int, rng: np.random.Generator
) -> NDArray[np.intp]:
    """Draw studies of n people without replacement, with the groups and orders of a study.

    Parameters
    ----------
    pool
        The people.
    wanted
        Group and order of each of the n participants. Where the pool lacks an order, or has it too
        seldom, anyone of the group is taken: its people then all drove one fixed order. A pool
        without groups has one, "".
    studies
        How many.

    Returns
    -------
    NDArray
        Shape (studies, n): rows of the pool; a column holds people of one group.
    """
    grouped = {group for group, _ in wanted} <= set(pool.groups)
    drawn = []
    for group in sorted({group for group, _ in wanted}) if grouped else [""]:
        people = np.flatnonzero(pool.groups == group) if grouped else np.arange(pool.size)
        orders = [order for of, order in wanted if not grouped or of == group]
        drawn += _by_order(pool, people, orders, studies, rng)
    return np.concatenate(drawn, axis=1)


def _by_order(
    pool: Pool,
    people: NDArray[np.intp],
    orders: list[str],
    studies: int,
    rng: np.random.Generator,
) -> list[NDArray[np.intp]]:
    names, wanted = np.unique(orders, return_counts=True)
    of_order = [people[pool.orders[people] == name] for name in names]
    if any(len(them) < count for them, count in zip(of_order, wanted, strict=True)):
        of_order, wanted = [people], np.array([len(orders)])
    return [
        _without_replacement(them, int(count), studies, rng)
        for them, count in zip(of_order, wanted, strict=True)
    ]


def _without_replacement(
    people: NDArray[np.intp], count: int, studies: int, rng: np.random.Generator
) -> NDArray[np.intp]:
    keys = rng.random((studies, len(people)))
    return people[np.argpartition(keys, count - 1, axis=1)[:, :count]]


def pool_error(drawn: NDArray[np.intp], rejected: NDArray[np.bool_], size: int) -> float:
    """Return the standard error that a power has from the pool being a sample of people.

    The infinitesimal jackknife for draws without replacement, less its Monte-Carlo bias, and not
    above Hoeffding's bound for a U-statistic.

    Parameters
    ----------
    drawn
        Shape (studies, n): rows of the pool.
    rejected
        Shape (studies,): whether the test rejected.
    size
        Number of people in the pool.

    References
    ----------
    Wager & Athey (2018), JASA 113(523), 1228-1242; Hoeffding (1948), Annals of Mathematical
    Statistics 19(3), 293-325.
    """
    studies, n = drawn.shape
    power = float(rejected.mean())
    share = n / size
    counts = np.bincount(drawn[rejected].ravel(), minlength=size) / studies
    inclusion = np.bincount(drawn.ravel(), minlength=size) / studies
    covariance = counts - inclusion * power
    noise = size * share * (1 - share) * power * (1 - power) / studies
    factor = (size - 1) / size * (size / (size - n)) ** 2
    variance = factor * max(0.0, float((covariance**2).sum()) - noise)
    return float(np.sqrt(min(variance, share * power * (1 - power))))
