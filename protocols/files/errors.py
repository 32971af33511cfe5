"""The one exception for faulty input; its message tells what to change."""

LONGEST = 1200
"""Characters of a fault; the middle of a longer one is left out."""


class InputError(Exception):
    """Input that cannot be used.

    The message is one line: where, what, and what is allowed. The command line prints it
    and exits with 2; nothing is overwritten or left half-written.

    Parameters
    ----------
    faults
        One line per fault, at least one; the one to correct first comes first.

    Examples
    --------
    >>> str(InputError("a.yaml:3: title: missing", "a.yaml:7: laps: needs at least 1"))
    'a.yaml:3: title: missing (and 1 more)'
    """

    def __init__(self, *faults: str) -> None:
        if not faults:
            raise TypeError("an InputError needs at least one fault")
        super().__init__(*(_one_line(fault) for fault in faults))

    @property
    def faults(self) -> tuple[str, ...]:
        """Every fault, one line each."""
        return self.args

    def __str__(self) -> str:
        first, *others = self.faults
        return first if not others else f"{first} (and {len(others)} more)"


def _one_line(fault: str) -> str:
    """Return a fault as one line that fits a screen; its end is what is allowed."""
    line = " ".join(fault.split())
    if len(line) <= LONGEST:
        return line
    return f"{line[: LONGEST * 2 // 3]} ... {line[-LONGEST // 3 :]}"
