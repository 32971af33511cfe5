"""What happens to a person's link from step to step, in words for the record."""

from collections.abc import Iterator, Mapping
from typing import Any

from participants.live.driver import MOST_AGE_S


class LinkWatch:
    """Tells when inputs stop and come again, when a page is left, and when the device changes.

    Parameters
    ----------
    role
        Whose link: ``driver`` or ``demonstrator``, as in the names of the record's columns.

    Examples
    --------
    >>> watch = LinkWatch("driver")
    >>> list(watch.changes({"driver_device": "gamepad", "driver_sent_age_s": 0.01}))
    []
    >>> list(watch.changes({"driver_device": "keyboard", "driver_sent_age_s": 0.9}))
    [('inputs stopped', 'the newest is 0.90 s old'), ('device', 'gamepad to keyboard')]
    """

    def __init__(self, role: str) -> None:
        self._role = role
        self._heard, self._attentive = True, True
        self._device: str | None = None

    def changes(self, telemetry: Mapping[str, Any]) -> Iterator[tuple[str, str | None]]:
        """Yield what has changed since the last step: event and note."""
        age = telemetry.get(f"{self._role}_sent_age_s")
        if age is None:  # no connection: that is an event of its own
            return
        heard = age <= MOST_AGE_S
        if heard != self._heard:
            yield ("inputs are back", None) if heard else (
                "inputs stopped", f"the newest is {age:.2f} s old",
            )  # fmt: skip
        attentive = telemetry.get(f"{self._role}_attentive", True)
        if attentive != self._attentive:
            yield ("page is back" if attentive else "page left"), None
        device = telemetry[f"{self._role}_device"]
        if self._device not in (None, device):
            yield "device", f"{self._device} to {device}"
        self._heard, self._attentive, self._device = heard, attentive, device
