"""The smallest p that an exact test can give with so many people."""

from collections import Counter
from collections.abc import Iterator

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


def out_of_reach(protocol: StudyProtocol) -> Iterator[str]:
    """Yield, in words, each family whose tests cannot be significant with the people planned.

    Tests of equivalence have no such bound.
    """
    n = protocol.cohort.participants
    families = Counter(
        a.family
        for a in protocol.analyses
        if a.kind == "confirmatory" and a.equivalence_margin is None
    )
    for family, tests in families.items():
        needed = people_needed(tests)
        if n < needed:
            people = "1 participant" if n == 1 else f"{n} participants"
            of = "1 test" if tests == 1 else f"{tests} tests"
            yield (
                f"with {people} nothing in family '{family}' ({of}) can be significant: the "
                f"smallest p after Holm is {min(1.0, tests * smallest_p(n)):.2g}; {needed} "
                "complete pairs are needed"
            )
