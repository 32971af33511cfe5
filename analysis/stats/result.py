"""The one type every test and every estimate returns."""

import math
from dataclasses import dataclass
from typing import ClassVar, Self


@dataclass(frozen=True, slots=True, kw_only=True)
class TestResult:
    """What a test or an estimate found, ready to be printed.

    Attributes
    ----------
    name
        The test or the quantity, as a table names it.
    quantity
        What ``estimate`` is, with its unit.
    estimate
        Point estimate; NaN where there is none.
    low, high
        Interval of ``level`` around the estimate; NaN where there is none.
    level
        Confidence level of the interval.
    statistic, statistic_name
        Test statistic and its symbol.
    p
        Two-sided p-value unless ``method`` names another one; NaN for an estimate without a test.
    n
        Number of independent units (pairs or participants) that were used.
    method
        How it was computed, for the methods text.
    checks
        Assumptions that were checked, and what was found.
    notes
        What else a reader must know: ties, zeros, fallbacks.
    why_not
        Why it could not be computed; None when it was.
    """

    __test__: ClassVar[bool] = False  # pytest would take the name for a test case

    name: str
    quantity: str = ""
    estimate: float = math.nan
    low: float = math.nan
    high: float = math.nan
    level: float = 0.95
    statistic: float = math.nan
    statistic_name: str = ""
    p: float = math.nan
    n: int
    method: str = ""
    checks: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    why_not: str | None = None

    @classmethod
    def missing(cls, name: str, n: int, why_not: str) -> Self:
        """Return the result of something that cannot be computed.

        Examples
        --------
        >>> TestResult.missing("paired t-test", 1, "needs at least 2 pairs").computed
        False
        """
        return cls(name=name, n=n, why_not=why_not)

    @property
    def computed(self) -> bool:
        """Whether there is a result."""
        return self.why_not is None
