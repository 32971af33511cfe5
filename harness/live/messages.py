"""What browsers may send: typed, with ranges; everything else is refused."""

import math
from typing import Annotated, Literal

import msgspec
from msgspec import Meta, Struct

MOST_BYTES = 16_384
"""Longest message, bytes: a page of answers fits, with text."""

Share = Annotated[float, Meta(ge=-1, le=1)]
Text = Annotated[str, Meta(max_length=2000)]
Short = Annotated[str, Meta(max_length=300)]


class Message(Struct, tag_field="type", forbid_unknown_fields=True):
    """Any message from a browser."""


class Hello(Message, tag="hello"):
    """The first message of a connection: the link's token, and what the browser is."""

    token: Short
    person: Short | None = None
    ids: Annotated[dict[Short, Short], Meta(max_length=8)] = {}
    agent: Short = ""
    width: Annotated[int, Meta(ge=0, le=20000)] = 0
    height: Annotated[int, Meta(ge=0, le=20000)] = 0
    view: Literal["first-person", "plan"] = "plan"


class Stick(Message, tag="input"):
    """Where the stick stands: ``n`` rises, ``sent`` is the browser's own clock in ms."""

    n: Annotated[int, Meta(ge=0, le=2**40)]
    sent: Annotated[float, Meta(ge=0, le=1e13)]
    f: Share
    l: Share  # noqa: E741  # short names: sent thirty times a second
    c: bool = False
    dev: Literal["keyboard", "gamepad", "touch"] = "keyboard"
    frames: Annotated[int, Meta(ge=0, le=1000)] = 0
    att: bool = True


class Pong(Message, tag="pong"):
    """The answer to a ping."""

    id: Annotated[int, Meta(ge=0, le=2**40)]


class Answered(Message, tag="answer"):
    """What was entered on a page."""

    request: Annotated[int, Meta(ge=0, le=2**40)]
    entered: Annotated[dict[Short, int | float | Text | None], Meta(max_length=200)]


class Withdraw(Message, tag="withdraw"):
    """The participant wants to stop."""

    reason: Text = ""


class Comfortable(Message, tag="comfortable"):
    """The participant has practised enough."""


class Order(Message, tag="order"):
    """What an experimenter wants done."""

    do: Literal[
        "start", "pause", "resume", "stop", "repeat", "emergency", "note", "skip", "end", "withdraw"
    ]
    participant: Short
    text: Text = ""


Received = Hello | Stick | Pong | Answered | Withdraw | Comfortable | Order

_DECODER = msgspec.json.Decoder(Received)


def decode(content: bytes | str) -> Received | None:
    """Return a message; None for anything that is none.

    Examples
    --------
    >>> decode(b'{"type": "pong", "id": 3}')
    Pong(id=3)
    >>> decode(b'{"type": "input", "n": 1, "sent": 0, "f": 9, "l": 0}') is None
    True
    """
    if len(content) > MOST_BYTES:
        return None
    try:
        message: Received = _DECODER.decode(content)
    except (msgspec.MsgspecError, UnicodeError, RecursionError):
        return None
    if isinstance(message, Answered) and not all(map(_sound, message.entered.values())):
        return None
    return message


def _sound(value: object) -> bool:
    return not isinstance(value, float) or math.isfinite(value)
