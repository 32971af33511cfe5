"""Studies drawn from a pool of people, and the pool's own error."""

import numpy as np
from numpy.typing import NDArray

from analysis.power.pool import Pool


def draw_studies(
    pool: Pool, orders: list[str], studies: int, rng: np.random.Generator
) -> NDArray[np.intp]:
    """Draw studies of n people without replacement, with the orders that a study would have.

    Parameters
    ----------
    pool
        The people.
    orders
        The order of each of the n participants. Where the pool lacks an order, or has it too
        seldom, anyone is taken: its people then all drove one fixed order.
    studies
        How many.

    Returns
    -------
    NDArray
        Shape (studies, n): rows of the pool.
    """
    n = len(orders)
    names, wanted = np.unique(orders, return_counts=True)
    of_order = [np.flatnonzero(pool.orders == name) for name in names]
    if any(len(people) < count for people, count in zip(of_order, wanted, strict=True)):
        of_order, wanted = [np.arange(pool.size)], np.array([n])
    return np.concatenate(
        [_without_replacement(people, int(count), studies, rng)
         for people, count in zip(of_order, wanted, strict=True)],
        axis=1,
    )  # fmt: skip


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
