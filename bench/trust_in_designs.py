"""Can the tests be trusted in the design that was chosen? Orders, groups, unfinished laps, skew.

    python bench/trust_in_designs.py --pool STUDY [--cohorts 1000] [--seed 0] [--only orders]

Draws cohorts of twelve from the people of a four-lap study (the shipped cohort's shape: skewed,
contrasts of unequal spread) and from symmetric ones, and prints Markdown tables: how often the
declared test of lap times rejects a true null hypothesis, how often its interval holds the truth,
how often an effect is found, how equivalence does on skewed differences. The tables in
docs/analysis.md are its output.
"""

import argparse
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

import numpy as np
import pandas as pd

from analysis.estimands import ESTIMANDS
from analysis.frames import study_frames
from analysis.lap_time_test import compare_laps
from analysis.outcomes import by_participant
from analysis.place import practice_of
from analysis.power.adjusted import adjusted, log_differences
from analysis.power.pool import Pool
from analysis.power.vectorised import signed_rank_p, tost_p
from analysis.stats.mean_difference import mean_difference
from analysis.stats.mixed_model import lap_time_model
from analysis.stats.random_intercept import fit_random_intercept
from analysis.stats.rank_sum import rank_sum
from analysis.stats.ratio import ratio_of_means
from analysis.stats.signed_rank import signed_rank
from protocols.declared import Comparison
from protocols.orders import Orders, designed_orders
from protocols.record.reader import open_study

N = 12
CONDITIONS = ("baseline", "limited", "human-assisted", "model-assisted")
PAIRS = (
    ("limited", "baseline"),
    ("model-assisted", "limited"),
    ("model-assisted", "human-assisted"),
)
SQUARE = designed_orders(Orders(use="williams"), CONDITIONS)
ORDERS = {
    "fixed": [CONDITIONS] * N,
    "1 of 12 reversed": [CONDITIONS] * (N - 1) + [CONDITIONS[::-1]],
    "2 of 12 in other orders of a square": [CONDITIONS] * (N - 2) + [*SQUARE[1:3]],
    "Williams square": list(SQUARE) * (N // 4),
    "Williams square, 2 of 12 lost": (list(SQUARE) * (N // 4))[: N - 2],
}

Rng = np.random.Generator
People = np.ndarray
"""Shape (people, conditions): log lap times, log s."""


def shipped_people(study: Path) -> People:
    """Return complete people of a recorded four-lap study."""
    wide = by_participant(study_frames(open_study(study)), "lap_time_s")[list(CONDITIONS)]
    return np.log(wide.dropna().to_numpy())


def symmetric_people(rng: Rng, n: int, effect: float = 0.0) -> People:
    """Return people whose log lap times are normal: 0.3 between them, 0.12 from lap to lap."""
    logs = rng.normal(4.2, 0.3, (n, 1)) + rng.normal(0, 0.12, (n, 4))
    return logs + np.array([0.0, 0.0, 0.0, effect])


def without_effect(people: People, rng: Rng) -> People:
    """Return people for whom the conditions make no difference: each one's laps are shuffled.

    Conditions are centred first, so that what is shuffled is a person's own unevenness.
    """
    return rng.permuted(people - people.mean(axis=0), axis=1)


def laps(people: People, orders: Sequence[Sequence[str]], practice: float) -> pd.DataFrame:
    """Return laps of people in given orders; each lap is faster by practice than the one before."""
    rows = []
    for i, (logs, order) in enumerate(zip(people, orders, strict=True)):
        for place, condition in enumerate(order, start=1):
            log_time = logs[CONDITIONS.index(condition)] + np.log1p(-practice) * (place - 1)
            rows.append((f"P{i:02d}", condition, place, np.exp(log_time)))
    return pd.DataFrame(rows, columns=["participant", "condition", "place", "lap_time_s"])


def share(values: Sequence[float]) -> str:
    """Return a share in percent."""
    return f"{100 * float(np.mean(values)):.1f}%"


def many(
    draw: Callable[[Rng, int], People],
    orders: Sequence[Sequence[str]],
    practice: float,
    cohorts: int,
    rng: Rng,
) -> tuple[np.ndarray, np.ndarray, Pool]:
    """Return log times of many cohorts, with their places, as the power computation takes them.

    Returns
    -------
    tuple
        Log times (cohorts x people, conditions), rows of each cohort, and both as a pool.
    """
    places = np.array([[order.index(c) + 1 for c in CONDITIONS] for order in orders], dtype=float)
    logs = np.concatenate([draw(rng, len(orders)) for _ in range(cohorts)])
    every = np.tile(places, (cohorts, 1))
    logs += np.log1p(-practice) * (every - 1)
    said = np.array([" > ".join(order) for order in orders])
    pool = Pool(CONDITIONS, logs, every, {}, {}, np.tile(said, cohorts), np.full(len(logs), ""))
    return logs, np.arange(len(logs)).reshape(cohorts, -1), pool


def wilcoxon_p(logs: np.ndarray, pair: tuple[str, str]) -> np.ndarray:
    """Return the p of each cohort's log ratios."""
    a, b = (CONDITIONS.index(c) for c in pair)
    return signed_rank_p(logs[..., a] - logs[..., b])


def adjusted_p(pool: Pool, drawn: np.ndarray, pair: tuple[str, str]) -> np.ndarray:
    """Return the p of each cohort's log ratios less the places' effects, as a report tests them."""
    analysis = Comparison(name="pair", condition=pair[0], reference=pair[1])
    return signed_rank_p(log_differences(pool, drawn, adjusted(pool, drawn), analysis))


def orders_table(pool: People, cohorts: int, seed: int) -> Iterator[str]:
    """Yield how often a true null hypothesis is rejected, and a verdict given, by order."""
    pairs = " | ".join(f"{c} - {r}" for c, r in PAIRS)
    yield f"| people | order | practice a lap | what is done | {pairs} | verdict, no caution |"
    yield "|---|---|---|---|---|---|---|---|"
    sources: dict[str, Callable[[Rng, int], People]] = {
        "shipped": lambda r, n: without_effect(pool[r.permutation(len(pool))[:n]], r),
        "symmetric": symmetric_people,
    }
    for source, draw in sources.items():
        for name, orders in ORDERS.items():
            for practice in (0.0, 0.04, 0.08):
                rng = np.random.default_rng([seed, 1])
                one = laps(draw(rng, len(orders)), orders, practice)
                kind = practice_of(one, *PAIRS[1])
                found = [
                    rejected(
                        kind,
                        draw,
                        orders=orders,
                        practice=practice,
                        cohorts=cohorts,
                        pair=pair,
                        seed=seed,
                    )
                    for pair in PAIRS
                ]
                verdict = found[1] if kind == "balanced" else [False]
                yield (
                    f"| {source} | {name} | {100 * practice:.0f}% | {kind} | "
                    f"{' | '.join(map(share, found))} | {share(verdict)} |"
                )


def rejected(
    kind: str,
    draw: Callable[[Rng, int], People],
    *,
    orders: Sequence[Sequence[str]],
    practice: float,
    cohorts: int,
    pair: tuple[str, str],
    seed: int,
) -> np.ndarray:
    """Return in which cohorts the declared test rejects."""
    rng = np.random.default_rng([seed, 1])
    if kind == "adjusted":  # a mixed model for each cohort: a quarter of them must do
        tables = (laps(draw(rng, len(orders)), orders, practice) for _ in range(cohorts // 4))
        p = [lap_time_model(t, pair[1], rng, wanted=[pair[0]])[0].p for t in tables]
        return np.array(p) <= 0.05
    logs, drawn, pool = many(draw, orders, practice, cohorts, rng)
    if kind != "balanced":
        return wilcoxon_p(logs[drawn], pair) <= 0.05
    return adjusted_p(pool, drawn, pair) <= 0.05


def power_table(pool: People, cohorts: int, seed: int) -> Iterator[str]:
    """Yield how often an effect of -0.12 is found in a Williams square, by three tests.

    The mixed model gets the same cohorts, so that the difference between two tests has a small
    error of its own. Its places take practice up exactly: it is fitted without practice, and a few
    cohorts with it show that its p is the same.
    """
    yield (
        "| people | practice a lap | Wilcoxon, not adjusted | Wilcoxon, adjusted | mixed model | "
        "mixed model less adjusted |"
    )
    yield "|---|---|---|---|---|---|"
    square, pair, effect = ORDERS["Williams square"], PAIRS[1], np.array([0.0, 0.0, 0.0, -0.12])

    def shipped(rng: Rng, n: int) -> People:
        return without_effect(pool[rng.permutation(len(pool))[:n]], rng) + effect

    def symmetric(rng: Rng, n: int) -> People:
        return symmetric_people(rng, n) + effect

    for name, draw in {"symmetric": symmetric, "shipped": shipped}.items():
        model = np.empty(0)
        for practice in (0.0, 0.04, 0.08):
            rng = np.random.default_rng([seed, 2])
            logs, drawn, people = many(draw, square, practice, cohorts, rng)
            plain = wilcoxon_p(logs[drawn], pair) <= 0.05
            less_place = adjusted_p(people, drawn, pair) <= 0.05
            few = drawn if practice == 0.0 else drawn[:20]
            tables = (laps(logs[rows], square, 0.0) for rows in few)  # practice is in them
            p = [lap_time_model(t, pair[1], rng, wanted=[pair[0]])[0].p for t in tables]
            model = np.array(p) if practice == 0.0 else model
            if not np.allclose(p, model[: len(p)], atol=1e-6):
                raise ValueError(f"practice of {practice} changes the mixed model's p")
            found = model <= 0.05
            apart = found.astype(float) - less_place
            error = 100 * apart.std(ddof=1) / np.sqrt(cohorts)
            yield (
                f"| {name} | {100 * practice:.0f}% | {share(plain)} | {share(less_place)} | "
                f"{share(found)} | {100 * apart.mean():.1f} ± {error:.1f} points |"
            )


def tost_table(pool: People, cohorts: int, seed: int) -> Iterator[str]:
    """Yield how often TOST calls conditions alike, on the pool's differences in seconds.

    They are moved to a true mean difference of the margin, of minus the margin, and of 0.
    """
    yield "| differences | margin | people | true: + margin | true: - margin | true: 0 |"
    yield "|---|---|---|---|---|---|"
    seconds = np.exp(pool)
    for (condition, reference), margin in zip(PAIRS, (20.0, 20.0, 5.0), strict=True):
        d = seconds[:, CONDITIONS.index(condition)] - seconds[:, CONDITIONS.index(reference)]
        for n in (12, 24, 48):
            rng = np.random.default_rng([seed, 6])
            drawn = np.array([rng.permutation(len(d))[:n] for _ in range(cohorts)])
            rows = (d - d.mean())[drawn]
            cells = [share(tost_p(rows + at, margin) <= 0.05) for at in (margin, -margin, 0.0)]
            yield f"| {condition} - {reference} | {margin:g} s | {n} | {' | '.join(cells)} |"


def coverage_table(pool: People, cohorts: int, seed: int) -> Iterator[str]:
    """Yield how often each interval of 95% holds the pool's own value, in a fixed order."""
    yield f"| interval | {' | '.join(f'{c} - {r}' for c, r in PAIRS)} |"
    yield "|---|---|---|---|"
    intervals = {
        "Hodges-Lehmann of log ratios (first screen)": lambda a, b: signed_rank(
            np.log(a) - np.log(b)
        ),
        "Hodges-Lehmann of seconds": lambda a, b: signed_rank(a - b),
        "mean difference, t": lambda a, b: mean_difference(a - b),
        "ratio of means, Fieller": ratio_of_means,
        "own log contrast, t": lambda a, b: mean_difference(np.log(a) - np.log(b)),
    }
    seconds = np.exp(pool)
    for name, interval in intervals.items():
        cells = []
        for condition, reference in PAIRS:
            a, b = seconds[:, CONDITIONS.index(condition)], seconds[:, CONDITIONS.index(reference)]
            truth, rng = interval(a, b).estimate, np.random.default_rng([seed, 3])
            held = []
            for _ in range(cohorts):
                drawn = rng.permutation(len(pool))[:N]
                found = interval(a[drawn], b[drawn])
                held.append(found.low <= truth <= found.high)
            cells.append(share(held))
        yield f"| {name} | {' | '.join(cells)} |"
    held_in_square = " | ".join(_in_square(pool, cohorts, seed))
    yield f"| the first screen's, in a Williams square | {held_in_square} |"


def _in_square(pool: People, cohorts: int, seed: int) -> list[str]:
    """Return how often the first screen's interval holds, less places, with practice of 4%."""
    cells, square = [], ORDERS["Williams square"]
    for condition, reference in PAIRS:
        ratios = pool[:, CONDITIONS.index(condition)] - pool[:, CONDITIONS.index(reference)]
        truth, rng, held = signed_rank(ratios).estimate, np.random.default_rng([seed, 3]), []
        for _ in range(cohorts):
            table = laps(pool[rng.permutation(len(pool))[:N]], square, 0.04)
            found = compare_laps(table, condition, reference, "complete pairs", rng).test
            held.append(found.low <= truth <= found.high)
        cells.append(share(held))
    return cells


def groups_table(cohorts: int, seed: int) -> Iterator[str]:
    """Yield how often groups that do not differ are told apart."""
    yield "| design | mixed model, Kenward-Roger | rank-sum |"
    yield "|---|---|---|"
    rng = np.random.default_rng([seed, 4])
    found = []
    for _ in range(cohorts):
        person = rng.normal(4.2, 0.2, 6)
        y = np.repeat(person, 10) + rng.normal(0, 0.1, 60)
        x = np.column_stack([np.ones(60), np.repeat([0.0, 1.0] * 3, 10)])
        found.append(_between(y, x, np.repeat(np.arange(6), 10)))
    yield f"| 2 x 3 people, 10 laps each | {' | '.join(map(share, np.transpose(found)))} |"
    found = []
    for _ in range(cohorts):
        person = rng.normal(4.2, 0.3, 16)
        y = np.repeat(person, 4) + rng.normal(0, 0.12, 64)
        x = np.column_stack([np.ones(64), np.repeat([0.0, 1.0] * 8, 4)])
        keep = rng.random(64) > 0.1
        found.append(_between(y[keep], x[keep], np.repeat(np.arange(16), 4)[keep]))
    yield (
        f"| 2 x 8 people, 4 laps each, a tenth missing | "
        f"{' | '.join(map(share, np.transpose(found)))} |"
    )


def _between(y: np.ndarray, x: np.ndarray, people: np.ndarray) -> list[bool]:
    from scipy import stats  # noqa: PLC0415  # only here

    fit = fit_random_intercept(y, x, people)
    estimate, error, df = fit.contrast([0.0, 1.0])
    model = 2 * stats.t.sf(abs(estimate / error), df)
    means = pd.Series(y).groupby(people).mean().to_numpy()
    return [model <= 0.05, rank_sum(means[1::2], means[::2]).p <= 0.05]


def unfinished_table(cohorts: int, seed: int) -> Iterator[str]:
    """Yield size and power with a limit that leaves 18% and 32% of two conditions unfinished."""
    yield "| an unfinished lap counts as | size | power | estimate (true: 15% slower) |"
    yield "|---|---|---|---|"
    for estimand in ESTIMANDS:
        cells = []
        for effect in (0.0, 0.15):
            rng, p, sizes = np.random.default_rng([seed, 5]), [], []
            for _ in range(cohorts):
                tested = compare_laps(_limited(rng, effect, estimand), "y", "x", estimand, rng)
                p.append(tested.test.p <= 0.05)
                sizes.append(tested.test.estimate)
            cells.append(share(p))
        shown = "none" if estimand == "worst rank" else f"{100 * np.expm1(np.mean(sizes)):.0f}%"
        yield f"| {estimand} | {' | '.join(cells)} | {shown} |"


def _limited(rng: Rng, effect: float, estimand: str) -> pd.DataFrame:
    """Return two laps of twelve people under a time limit of 83 s, counted in one of three ways."""
    logs = rng.normal(4.2, 0.2, (N, 1)) + rng.normal(0, 0.13, (N, 2)) + np.array([0.0, effect])
    over = logs > 4.42
    times = np.where(over, np.exp(4.42) if estimand == "limit" else np.nan, np.exp(logs))
    return pd.DataFrame(
        [
            (f"P{i:02d}", c, at + 1, times[i, at], bool(over[i, at]) and estimand == "worst rank")
            for i in range(N)
            for at, c in enumerate("xy")
        ],
        columns=["participant", "condition", "place", "lap_time_s", "worst"],
    )


def main() -> None:
    """Draw, count, print."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--pool", type=Path, required=True)
    parser.add_argument("--cohorts", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--only", default="")
    o = parser.parse_args()
    pool = shipped_people(o.pool)
    print(f"{o.cohorts} cohorts of {N}; pool: {len(pool)} complete people.\n", flush=True)
    tables = {
        "coverage": lambda: coverage_table(pool, o.cohorts, o.seed),
        "power": lambda: power_table(pool, o.cohorts, o.seed),
        "tost": lambda: tost_table(pool, o.cohorts, o.seed),
        "groups": lambda: groups_table(o.cohorts, o.seed),
        "unfinished": lambda: unfinished_table(o.cohorts, o.seed),
        "orders": lambda: orders_table(pool, o.cohorts, o.seed),
    }
    for name, lines in tables.items():
        if o.only in ("", name):
            print(f"### {name}\n")
            for line in lines():
                print(line, flush=True)
            print()


if __name__ == "__main__":
    main()
