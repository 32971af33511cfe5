"""The seam every demonstrator fits: it sees the room, and it may help."""

from typing import Protocol

from lad.assistant import Assistant
from participants.sight import Onlooker


class Demonstrator(Assistant, Onlooker, Protocol):
    """Watches and takes over; as a shadow it gets the same calls and its command does not count.

    In every step of every lap: ``look(sight)``, then ``assist(x)``.
    """
