"""What a check found, and the report on a part that all its checks make."""

from dataclasses import dataclass
from typing import Literal, Self

State = Literal["passed", "failed", "not checked"]


@dataclass(frozen=True, slots=True)
class CheckResult:
    """One check of one part.

    Attributes
    ----------
    check
        What was looked at, in a few words.
    state
        Not checked: another check's failure leaves nothing to look at, or the part cannot be
        looked at in this way; ``found`` has the reason.
    found
        What the part did.
    allowed
        What a study can work with.

    Examples
    --------
    >>> print(CheckResult("commands", "failed", "v = 3 m/s", "-0.7 to 0.7 m/s"))
    failed       commands: v = 3 m/s; allowed: -0.7 to 0.7 m/s
    """

    check: str
    state: State
    found: str
    allowed: str

    @classmethod
    def of(cls, check: str, fault: str | None, found: str, allowed: str) -> Self:
        """Return a failure when there is a fault; else that the check passed, and what was found.

        Parameters
        ----------
        check, found, allowed
            As the attributes.
        fault
            What is wrong; None when nothing is.
        """
        if fault is None:
            return cls(check, "passed", found, allowed)
        return cls(check, "failed", fault, allowed)

    def __str__(self) -> str:
        line = f"{self.check}: {self.found}; allowed: {self.allowed}"
        return f"{self.state:<11}  {' '.join(line.split())}"


@dataclass(frozen=True, slots=True)
class PartReport:
    """Every check of one part, in the order in which a study would meet what they check.

    Attributes
    ----------
    part
        The name that it was given, or its factory's.
    role
        What it was checked as.
    results
        One for each check.
    """

    part: str
    role: str
    results: tuple[CheckResult, ...]

    @property
    def passed(self) -> bool:
        """Whether no check failed."""
        return not self.failed

    @property
    def failed(self) -> tuple[str, ...]:
        """The names of the checks that failed."""
        return tuple(result.check for result in self.results if result.state == "failed")

    def __str__(self) -> str:
        return "\n".join(map(str, self.results))
