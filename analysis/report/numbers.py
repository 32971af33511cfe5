"""Numbers as a report prints them."""

import math

NOTHING = "–"
"""Printed in place of a number; a note gives the reason."""


def number(value: float, digits: int = 1) -> str:
    """Return a number with a proper minus sign.

    Examples
    --------
    >>> number(-20.64), number(float("nan"))
    ('−20.6', '–')
    """
    if not math.isfinite(value):
        return NOTHING
    text = f"{value:.{digits}f}"
    return text.replace("-", "−") if float(text) else text.lstrip("-")


def count(value: float) -> str:
    """Return a whole number."""
    return number(value, 0)


def rank_sum(value: float) -> str:
    """Return a sum of mid-ranks, which is whole or ends in a half.

    Examples
    --------
    >>> rank_sum(78.0), rank_sum(60970.5), rank_sum(float("nan"))
    ('78', '60970.5', '–')
    """
    return number(value, 0 if value == round(value, 0) else 1)


def percent(value: float, digits: int = 0) -> str:
    """Return a percentage that is given in percent."""
    return NOTHING if not math.isfinite(value) else f"{number(value, digits)}%"


def p_value(p: float) -> str:
    """Return a p-value as journals print it.

    Examples
    --------
    >>> p_value(0.0004), p_value(0.0312), p_value(0.5), p_value(1.0)
    ('< .001', '.031', '.50', '1.00')
    """
    if not math.isfinite(p):
        return NOTHING
    if p < 0.001:
        return "< .001"
    text = f"{p:.3f}" if p < 0.1 else f"{p:.2f}"
    return text.removeprefix("0")


def is_p(p: float) -> str:
    """Return "p < .001" or "p = .031"."""
    text = p_value(p)
    return f"p {text}" if text.startswith("<") else f"p = {text}"


def interval(low: float, high: float, digits: int = 1) -> str:
    """Return an interval; nothing when it has no ends.

    Examples
    --------
    >>> interval(-25.2, -13.44)
    '−25.2 to −13.4'
    """
    if not (math.isfinite(low) and math.isfinite(high)):
        return NOTHING
    return f"{number(low, digits)} to {number(high, digits)}"


def with_interval(value: float, low: float, high: float, digits: int = 1) -> str:
    """Return a number and its interval, short enough for a table.

    Examples
    --------
    >>> with_interval(-20.5, -24.3, -16.7), with_interval(1.0, float("nan"), 1.0)
    ('−20.5 [−24.3, −16.7]', '1.0')
    """
    if not (math.isfinite(low) and math.isfinite(high)):
        return number(value, digits)
    return f"{number(value, digits)} [{number(low, digits)}, {number(high, digits)}]"


def plural(n: int, one: str, many: str | None = None) -> str:
    """Return a count with its noun.

    Examples
    --------
    >>> plural(1, "lap"), plural(2, "lap"), plural(0, "person", "people")
    ('1 lap', '2 laps', '0 people')
    """
    return f"{n} {one if n == 1 else many or f'{one}s'}"
