"""What a living person's link says in a step, and how a part that wraps another passes it on."""

from collections.abc import Callable, Mapping
from typing import Any

Telemetry = Callable[[], Mapping[str, Any]]
"""Returns columns of the step table by name; empty where nothing is known."""


def telemetry_of(part: object) -> Telemetry | None:
    """Return a part's telemetry; None for a part that has none, as simulated ones do."""
    found: Telemetry | None = getattr(part, "telemetry", None)
    return found
