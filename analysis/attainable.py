"""The smallest p that an exact test can give with so many people."""

import math
from collections.abc import Iterator

from protocols.declared import Comparison
from protocols.study import StudyProtocol

ALPHA = 0.05


def smallest_p(n: int) -> float:
    """Return the smallest two-sided p of a signed-rank test of n differences that are not zero.

    All differences of one sign are the most extreme of 2^n equally probable assignments of signs.

    Examples
    --------
    >>> smallest_p(5), smallest_p(6), smallest_p(0)
    (0.0625, 0.03125, 1.0)
    """
    return min(1.0, 2.0 ** (1 - n))


def smallest_p_between(first: int, second: int) -> float:
    """Return the smallest two-sided p of a rank-sum test of two groups without ties.

    Examples
    --------
    >>> smallest_p_between(3, 3), smallest_p_between(4, 0)
    (0.1, 1.0)
    """
    return min(1.0, 2.0 / math.comb(first + second, first))


def people_needed(tests: int, alpha: float = ALPHA) -> int:
    """Return how many complete pairs a family of signed-rank tests needs to reject at all.

    Examples
    --------
    >>> people_needed(1), people_needed(3)
    (6, 7)
    """
    n = 1
    while tests * smallest_p(n) > alpha:
        n += 1
    return n


def least_p(protocol: StudyProtocol, analysis: Comparison, n: int) -> float:
    """Return the smallest p of an analysis when n people have all their laps; 0 without a bound.

    Groups have the sizes that the allocation's ratio gives them.
    """
    if analysis.equivalence_margin is not None:
        return 0.0
    if analysis.groups is None:
        return smallest_p(n)
    whole = sum(group.ratio for group in protocol.groups.values())
    first, second = (n * protocol.groups[g].ratio // whole for g in analysis.groups)
    return smallest_p_between(first, second)


def least_n(protocol: StudyProtocol, analysis: Comparison) -> int | None:
    """Return how many people an analysis needs so that it can be significant at all.

    A confirmatory one is corrected (Holm): at best the others of its family have smaller p-values
    and do not count, at worst all do; here all count that have such a bound. None for a test
    without one.
    """
    if analysis.equivalence_margin is not None:
        return None
    tests = 1
    if analysis.kind == "confirmatory":
        tests = sum(a.equivalence_margin is None for a in family_of(protocol, analysis.family))
    n = 1
    while tests * least_p(protocol, analysis, n) > ALPHA:
        n += 1
    return n


def family_of(protocol: StudyProtocol, family: str) -> tuple[Comparison, ...]:
    """Return the confirmatory analyses of a family."""
    return tuple(a for a in protocol.analyses if a.kind == "confirmatory" and a.family == family)


def out_of_reach(protocol: StudyProtocol) -> Iterator[str]:
    """Yield, in words, each family whose tests cannot be significant with the people planned.

    Tests of equivalence have no such bound.
    """
    n = protocol.cohort.participants
    for name in dict.fromkeys(a.family for a in protocol.analyses if a.kind == "confirmatory"):
        bounded = [a for a in family_of(protocol, name) if a.equivalence_margin is None]
        if not bounded:
            continue
        tests = len(bounded)
        lowest = min(1.0, tests * min(least_p(protocol, a, n) for a in bounded))
        if lowest <= ALPHA:
            continue
        needed = min(least for a in bounded if (least := least_n(protocol, a)) is not None)
        people = "1 participant" if n == 1 else f"{n} participants"
        of = "1 test" if tests == 1 else f"{tests} tests"
        whom = "people of all groups" if bounded[0].groups else "complete pairs"
        yield (
            f"with {people} nothing in family '{name}' ({of}) can be significant: the "
            f"smallest p after Holm is {lowest:.2g}; {needed} {whom} are needed"
        )
