"""One quantity of the paper beside ours, and the verdict that follows from the row's numbers."""

import math
from dataclasses import dataclass
from typing import Any, Literal

Kind = Literal["calibrated", "predicted", "descriptive"]
Verdict = Literal["holds", "differs", "none"]
Rule = Literal["near paper", "at least", "near zero", "interval near zero"]

FIELDS = (
    "section", "quantity", "unit", "paper", "ours", "n", "low", "high", "tolerance", "rule", "kind"
)  # fmt: skip
"""Of a row of the JSON, before its verdict."""

SLACK = 1e-9
"""Slack of a comparison: 0.9905 - 0.0055 is not exactly 0.985 in binary."""


@dataclass(frozen=True, slots=True)
class Row:
    """One quantity.

    Attributes
    ----------
    section
        Where the paper has it.
    quantity
        What it is; unique.
    unit
        Of all its numbers; ``""`` for none.
    paper
        What the paper prints; None where it prints nothing.
    ours
        What we found; NaN where it could not be computed.
    n
        How many independent laps, participants or runs ``ours`` is computed from.
    low, high
        Its interval; NaN where there is none. 95% for means and ratios, 90% for an equivalence
        test, quartiles for medians over permutations.
    kind
        Calibrated: fitted to the paper's figure. Predicted: it could have been different.
        Descriptive: reported only.
    tolerance
        Declared beforehand (see ``analysis.reproduction.tolerances``); None for none.
    rule
        What the tolerance means, as ``verdict_of`` explains it.
    """

    section: str
    quantity: str
    unit: str
    paper: float | None
    ours: float
    n: int
    low: float
    high: float
    kind: Kind
    tolerance: float | None = None
    rule: Rule = "near paper"

    @property
    def verdict(self) -> Verdict:
        """The verdict of these numbers; see ``verdict_of``."""
        return verdict_of(self.as_json())

    def as_json(self) -> dict[str, Any]:
        """Return the row as the JSON has it; what is not a number becomes None.

        The rule is None where there is no tolerance.
        """
        row = {name: _jsonable(getattr(self, name)) for name in FIELDS}
        if self.tolerance is None:
            row["rule"] = None
        return {**row, "verdict": verdict_of(row)}


def verdict_of(row: dict[str, Any]) -> Verdict:
    """Return the verdict of a row of the JSON, from its own numbers.

    Without a tolerance there is none. Otherwise the quantity holds when, by its rule,

    - ``near paper``: ours is within the tolerance of the paper's figure;
    - ``at least``: ours is no lower than the paper's figure less the tolerance;
    - ``near zero``: ours is within the tolerance of zero;
    - ``interval near zero``: so does the whole interval, ends not included.

    It differs when a number that the rule needs is missing.

    Examples
    --------
    >>> row = {"paper": 0.9905, "ours": 0.985, "low": None, "high": None, "tolerance": 0.0055,
    ...        "rule": "at least"}
    >>> verdict_of(row)
    'holds'
    """
    tolerance = row["tolerance"]
    if tolerance is None:
        return "none"
    needed = {
        "near paper": ("ours", "paper"),
        "at least": ("ours", "paper"),
        "near zero": ("ours",),
        "interval near zero": ("low", "high"),
    }[row["rule"]]
    numbers = [row[name] for name in needed]
    if any(number is None for number in numbers):
        return "differs"
    return "holds" if _holds(row["rule"], numbers, tolerance) else "differs"


def _holds(rule: Rule, numbers: list[float], tolerance: float) -> bool:
    if rule == "near paper":
        return abs(numbers[0] - numbers[1]) <= tolerance + SLACK
    if rule == "at least":
        return numbers[0] >= numbers[1] - tolerance - SLACK
    if rule == "near zero":
        return abs(numbers[0]) <= tolerance + SLACK
    return all(abs(end) < tolerance for end in numbers)


def _jsonable(value: Any) -> Any:
    return None if isinstance(value, float) and not math.isfinite(value) else value
