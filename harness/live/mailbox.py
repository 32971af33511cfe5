"""A seat whose other side is a browser: latest values, never queues of commands."""

import statistics
import threading
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

from harness.live.messages import Stick
from harness.session.clock import LapStoppedError
from participants.driver import WithdrewError
from participants.live.seat import Input, Request
from participants.survey import Answer

NO_OFFSET = float("inf")


@dataclass(slots=True)
class _Link:
    """The connection that has the seat."""

    number: int
    wake: Callable[[], None]
    offset: float = NO_OFFSET
    round_trip_s: float | None = None
    pings: dict[int, float] = field(default_factory=dict)
    trips: list[float] = field(default_factory=list)


class Mailbox:
    """One person's seat. The session's thread sits on one side, the server's on the other.

    Parameters
    ----------
    lockstep
        Whether a step waits for the input that answers its own picture: for programs that drive
        through the network in simulated time, never for people.
    on_change
        Told when a connection comes or goes.

    Attributes
    ----------
    beside
        What is shown beside each picture.
    """

    def __init__(
        self, *, lockstep: bool = False, on_change: Callable[[bool], None] = lambda _: None
    ) -> None:
        self._changed = threading.Condition()
        self._lockstep, self._on_change = lockstep, on_change
        self._link: _Link | None = None
        self._links = 0
        self._picture: dict[str, Any] | None = None
        self._shown = 0
        self._input: Input | None = None
        self._sent_s = 0.0
        self._frames = 0
        self._page: dict[str, Any] | None = None
        self._pages = 0
        self._entered: Mapping[str, Answer] | None = None
        self._withdrawal: str | None = None
        self._heard = time.monotonic()
        self.beside: dict[str, Any] = {}
        self._ended: LapStoppedError | None = None

    # The session's side -----------------------------------------------------------------

    def show(self, picture: Mapping[str, Any]) -> None:
        """Show what there is to see now; an older picture that was not sent yet is replaced."""
        with self._changed:
            link = self._put(picture)
        if link is not None:
            link.wake()

    def show_ahead(self, changes: Mapping[str, Any]) -> None:
        """Show where the step that begins will lead: the browser draws the way there meanwhile.

        Without it a key would be seen a whole step later.

        Parameters
        ----------
        changes
            What is different from the picture that is shown.
        """
        with self._changed:
            if self._lockstep or self._picture is None:
                return
            link = self._put({**self._picture, **changes})
        if link is not None:
            link.wake()

    def _put(self, picture: Mapping[str, Any]) -> _Link | None:
        """Replace the picture, and return who has to be told; nobody if it is shown already."""
        new = {**picture, "type": "picture", **self.beside}
        if not self._lockstep and self._picture == {**new, "n": self._shown}:
            return None
        self._shown += 1
        self._picture = {**new, "n": self._shown}
        return self._link

    def latest(self) -> Input | None:
        """Return the newest input with its age now; None before the first of this connection."""
        with self._changed:
            if self._lockstep:
                self._changed.wait_for(
                    lambda: (
                        self._ended is not None
                        or (self._input is not None and self._input.sequence >= self._shown)
                    )
                )
                self._raise_if_ended()
                return self._input
            if self._input is None or self._link is None:
                return None
            age = time.monotonic() - (self._sent_s + self._link.offset)
            frames, self._frames = min(self._frames, 30_000), 0
            return replace(
                self._input,
                age_s=max(age, 0.0),
                round_trip_s=self._link.round_trip_s,
                frames=frames,
            )

    def ask(self, request: Request) -> Mapping[str, Answer]:
        """Show a page and return what was entered on it, once it is."""
        with self._changed:
            self._pages += 1
            self._entered = None
            self._page = {
                "type": "page",
                "request": self._pages,
                "kind": request.kind,
                **request.content,
            }
            link = self._link
        if link is not None:
            link.wake()
        with self._changed:
            self._changed.wait_for(
                lambda: (
                    self._entered is not None
                    or self._withdrawal is not None
                    or self._ended is not None
                )
            )
            self._page = None
            self._raise_if_ended()
            if self._entered is None:
                raise WithdrewError(self._withdrawal or "")
            return self._entered

    def withdrawal(self) -> str | None:
        """Return why the person wants to stop, in their words; None when they do not."""
        return self._withdrawal

    def end(self, stop: LapStoppedError) -> None:
        """Have whatever waits here end."""
        with self._changed:
            self._ended = stop
            self._changed.notify_all()

    def _raise_if_ended(self) -> None:
        if self._ended is not None:
            raise self._ended

    # The server's side ------------------------------------------------------------------

    @property
    def connected(self) -> bool:
        """Whether a browser has the seat now."""
        return self._link is not None

    @property
    def round_trip_s(self) -> float | None:
        """Newest round trip, s; None without one."""
        link = self._link
        return None if link is None else link.round_trip_s

    @property
    def silent_s(self) -> float:
        """How long ago the last message from this seat's browser was received, s."""
        return time.monotonic() - self._heard

    @property
    def median_round_trip_s(self) -> float | None:
        """Median round trip of this connection, s; None before the first."""
        link = self._link
        return statistics.median(link.trips) if link is not None and link.trips else None

    @property
    def page_kind(self) -> str | None:
        """What kind of page is open; None while none is."""
        page = self._page
        return None if page is None else str(page["kind"])

    def connect(self, wake: Callable[[], None]) -> int:
        """Give the seat to a new connection, and return its number; the newest has the seat.

        Parameters
        ----------
        wake
            Called, on any thread, whenever there is something new to send.
        """
        with self._changed:
            self._links += 1
            self._heard = time.monotonic()
            before, self._link = self._link, _Link(self._links, wake)
            self._input = None  # an earlier connection's stick is nobody's now
            number = self._links
        if before is not None:
            before.wake()
        self._on_change(True)
        wake()
        return number

    def disconnect(self, number: int) -> None:
        """Take the seat from a connection, if it still has it."""
        with self._changed:
            if not self.has_seat(number):
                return
            self._link, self._input = None, None
        self._on_change(False)

    def has_seat(self, number: int) -> bool:
        """Tell whether a connection is the newest."""
        return self._link is not None and self._link.number == number

    def put_stick(self, stick: Stick) -> None:
        """Take a stick's position; one that is older than the last is dropped."""
        received = time.monotonic()
        with self._changed:
            self._heard = received
            if self._link is None or (self._input and stick.n <= self._input.sequence):
                return
            sent = stick.sent / 1000.0
            # The quickest message tells best how the two clocks differ.
            self._link.offset = min(self._link.offset, received - sent)
            self._sent_s = sent
            self._frames += stick.frames
            self._input = Input(
                forward=stick.f,
                left=stick.l,
                clutch=stick.c,
                sequence=stick.n,
                device=stick.dev,
                attentive=stick.att,
            )
            self._changed.notify_all()

    def put_answer(self, request: int, entered: Mapping[str, Answer]) -> None:
        """Take what was entered on a page; an answer to an earlier page is dropped."""
        with self._changed:
            if self._page is not None and request == self._page["request"]:
                self._entered = dict(entered)
                self._changed.notify_all()

    def skip(self) -> None:
        """Have the page that is open be left unanswered."""
        with self._changed:
            if self._page is not None:
                self._entered = {}
                self._changed.notify_all()

    def withdraw(self, reason: str) -> None:
        """Note that the person wants to stop."""
        with self._changed:
            self._withdrawal = reason or "no reason given"
            self._changed.notify_all()

    def ping(self, number: int) -> dict[str, Any]:
        """Return a ping to send now."""
        with self._changed:
            if self._link is not None:
                self._link.pings[number] = time.monotonic()
        trip = self.median_round_trip_s
        return {
            "type": "ping",
            "id": number,
            "round_trip_ms": None if trip is None else round(1000 * trip, 1),
        }

    def pong(self, number: int) -> None:
        """Take a ping's answer."""
        with self._changed:
            self._heard = time.monotonic()
            if self._link is not None and number in self._link.pings:
                self._link.round_trip_s = time.monotonic() - self._link.pings.pop(number)
                self._link.trips = [*self._link.trips[-49:], self._link.round_trip_s]

    def to_send(self, page_sent: int, picture_sent: int) -> tuple[list[dict[str, Any]], int, int]:
        """Return what a connection has not been sent yet, and what it will have been sent then."""
        with self._changed:
            news = []
            page = self._page["request"] if self._page else 0
            if self._page is not None and page != page_sent:
                news.append(self._page)
            elif self._page is None and page_sent:
                news.append({"type": "driving"})
            if self._picture is not None and self._shown != picture_sent and self._page is None:
                news.append(self._picture)
            return news, page, self._shown
