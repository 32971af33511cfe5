"""Whether a part has the methods a study calls, and can be called as it calls them."""

import inspect
from typing import Any

from harness.part_checks.result import CheckResult
from harness.part_checks.role import Role
from participants.driver import kind_of

NAME = "interface"


def interface(role: Role, part: Any) -> CheckResult:
    """Check a part's methods and, of a driver or impairment, its kind of participant."""
    signatures = {name: f"{name}({given})" for name, given in role.signatures.items()}
    fault = missing(part, role.signatures) or _wrong_kind(role, part)
    found = f"{type(part).__name__} with {', '.join(signatures.values())}"
    learns = "learn(helping, command)" if role.name == "assistant" else ""
    if learns and callable(getattr(part, "learn", None)):
        fault = fault or missing(part, {"learn": "helping, command"})
        found = f"{found}, {learns}"
    allowed = ", ".join(signatures.values()) + (f", and {learns} if it learns" if learns else "")
    return CheckResult.of(NAME, fault, found, allowed)


def missing(part: Any, signatures: Any) -> str | None:
    """Return the first method that a part lacks, or that takes something else; None for none."""
    for name, given in signatures.items():
        method = getattr(part, name, None)
        if not callable(method):
            return f"{type(part).__name__} has no method {name}"
        arguments = [argument for argument in given.split(", ") if argument]
        try:
            signature = inspect.signature(method)
        except ValueError:  # compiled code need not have one
            continue
        try:
            signature.bind(*arguments)
        except TypeError as error:
            return f"{name}{signature} cannot be called as {name}({given}): {error}"
    return None


def _wrong_kind(role: Role, part: Any) -> str | None:
    if role.name not in {"driver", "impairment"}:
        return None
    try:
        kind_of(part)
    except ValueError as error:
        return str(error)
    return None
