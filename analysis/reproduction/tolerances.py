"""What counts as reproduced, declared before anything was run. Other quantities have no verdict."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

from analysis.reproduction.row import Row, Rule


@dataclass(frozen=True, slots=True)
class Tolerance:
    """How far a quantity may be off, in its unit, and from what (``rows.verdict_of``)."""

    value: float
    rule: Rule


TOLERANCES: Mapping[str, Tolerance] = {
    # Course, driver and demonstrator were fitted to these three; other seeds may be this far off.
    "rd lap baseline": Tolerance(0.7, "near paper"),
    "rd lap limited": Tolerance(1.2, "near paper"),
    "rd lap demonstrator": Tolerance(1.0, "near paper"),
    # After one demonstration: within 3 s of the demonstrator, and an AUC of 0.95.
    "model after 1 minus demonstrator": Tolerance(3.0, "near zero"),
    "auc after 1": Tolerance(0.0, "at least"),
    # Medians of 0.985: the paper's 0.9905 and 0.9881 less these.
    "auc training median": Tolerance(0.0055, "at least"),
    "auc test median": Tolerance(0.0031, "at least"),
    # "Statistically similar" after three: equivalent within 2 s (TOST).
    "tost model after 3": Tolerance(2.0, "interval near zero"),
}
"""By quantity."""


def judged(row: Row) -> Row:
    """Return a row with the tolerance declared for its quantity; as it is when there is none."""
    declared = TOLERANCES.get(row.quantity)
    if declared is None:
        return row
    return replace(row, tolerance=declared.value, rule=declared.rule)
