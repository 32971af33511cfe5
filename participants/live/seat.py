"""Where a living person sits: what they are shown, and what they give."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Protocol

from participants.survey import Answer
from protocols.files.errors import InputError


@dataclass(frozen=True, slots=True)
class Input:
    """What a person's device said last.

    Attributes
    ----------
    forward, left
        The stick, each in [-1, 1] of full deflection.
    clutch
        Whether the takeover button is held or switched on.
    sequence
        Number of the message; rises.
    age_s
        From the moment it was sent to now, s.
    device
        What it comes from: keyboard, gamepad or touch.
    round_trip_s
        Newest round trip between the person's machine and ours, s; None before the first.
    frames
        Pictures drawn there since the last message.
    attentive
        Whether the page is visible and has the focus.
    """

    forward: float
    left: float
    clutch: bool = False
    sequence: int = 0
    age_s: float = 0.0
    device: str = "keyboard"
    round_trip_s: float | None = None
    frames: int = 0
    attentive: bool = True


@dataclass(frozen=True, slots=True)
class Request:
    """Something a person is asked for.

    Attributes
    ----------
    kind
        What kind of page it is, e.g. ``consent``, ``questions``, ``ready``.
    content
        What the page needs, as plain data.
    """

    kind: str
    content: Mapping[str, Any] = field(default_factory=dict)


class Seat(Protocol):
    """One person's place; its other side is a browser, or a test."""

    def show(self, picture: Mapping[str, Any]) -> None:
        """Show what there is to see now; an older picture that was not sent yet is replaced."""

    def latest(self) -> Input | None:
        """Return the newest input; None before the first."""

    def ask(self, request: Request) -> Mapping[str, Answer]:
        """Show a page and return what was entered on it, once it is.

        Raises
        ------
        WithdrewError
            When the person wants to stop.
        LapStoppedError
            When the session is ended from elsewhere.
        """

    def withdrawal(self) -> str | None:
        """Return why the person wants to stop, in their words; None when they do not."""


def occupied(role: str, seat: Seat | None) -> Seat:
    """Return the seat of a living person in a role.

    Raises
    ------
    InputError
        When there is none: a living person cannot be simulated.
    """
    if seat is None:
        raise InputError(
            f"{role} 'live': a living person needs a browser; allowed: `lad-study live`, "
            "or a simulated part"
        )
    return seat
