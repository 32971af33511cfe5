"""The one exception for faulty input; its message tells what to change."""


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
        super().__init__(*(" ".join(fault.split()) for fault in faults))

    @property
    def faults(self) -> tuple[str, ...]:
        """Every fault, one line each."""
        return self.args

    def __str__(self) -> str:
        first, *others = self.faults
        return first if not others else f"{first} (and {len(others)} more)"
