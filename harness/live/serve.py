"""Serve a live study until its last session is over, or until it is stopped."""

import asyncio
import contextlib
import json
import socket
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import urlsplit

import segno
import uvicorn

from harness.live.messages import MOST_BYTES
from harness.live.server import make_app
from harness.live.study import LiveStudy
from harness.live.tokens import LETTERS, Role
from harness.session.study_run import StudyRun
from protocols.files.errors import InputError
from protocols.record.atomic import write_whole
from protocols.record.store import locked
from protocols.registered_study import copy_registration
from protocols.registration import Registration

LOOK_S = 0.5
"""How often it is looked whether the study is over, s."""


@dataclass(frozen=True, slots=True)
class Address:
    """Where a study is served.

    Attributes
    ----------
    port
        0 takes a free one.
    lan
        Whether other machines of the local network may connect.
    public_origin
        What browsers see behind a reverse proxy, e.g. https://study.example.org; None without one.
    """

    port: int = 8080
    lan: bool = False
    public_origin: str | None = None


def serve_study(
    run: StudyRun,
    folder: Path,
    address: Address,
    say: Callable[[str], None],
    *,
    seats: int = 1,
    links: Path | None = None,
    plan: Registration | None = None,
    new_links: bool = False,
) -> int:
    """Serve a study, and return how many of its sessions are finished.

    Parameters
    ----------
    run, folder, address
        What is served, where it is kept, and to whom.
    say
        Told the links, line by line.
    seats
        Sessions at a time.
    links
        A file that gets the links as JSON.
    plan
        The registration that the study follows; it is copied into the folder.
    new_links
        Whether the links that were printed before open nothing any more.

    Raises
    ------
    InputError
        When the folder holds another study, the port is taken, or an address is no address.
    """
    public = _public(address.public_origin)
    with locked(folder), _listening(address) as listener:
        port = listener.getsockname()[1]
        hosts = [f"localhost:{port}", f"127.0.0.1:{port}"]
        if address.lan:
            hosts.insert(0, f"{_lan_address()}:{port}")
        origins = [f"http://{host}" for host in hosts]
        if public is not None:
            hosts.append(urlsplit(public).netloc)
            origins.insert(0, public)
        study = LiveStudy(run, folder, seats)
        if plan is not None:
            copy_registration(plan, folder)
        if new_links:
            study.new_links()
        named = _links(study, origins[0])
        if links is not None:
            write_whole(links, (json.dumps(named, indent=1) + "\n").encode())
        for role, link in named.items():
            say(f"{role:<13} {link}")
            if address.lan:
                say(_qr(link))
        if address.lan and public is None:
            say("Over plain http a browser gives pages of other machines no gamepad; keyboard and "
                "touch work.")  # fmt: skip
        server = web_server(study, frozenset(hosts), frozenset(origins))
        with contextlib.suppress(KeyboardInterrupt):  # Ctrl-C is how an experimenter ends a day
            asyncio.run(_serve(server, listener, study))
        return len(study.progress().finished)


def web_server(study: LiveStudy, hosts: frozenset[str], origins: frozenset[str]) -> uvicorn.Server:
    """Return the server of a live study; parameters are those of ``make_app``."""
    config = uvicorn.Config(
        make_app(study, hosts, origins), log_level="warning", access_log=False,
        ws_max_size=MOST_BYTES, ws="websockets-sansio", server_header=False, date_header=False,
        lifespan="off",
    )  # fmt: skip
    return uvicorn.Server(config)


async def _serve(server: uvicorn.Server, listener: socket.socket, study: LiveStudy) -> None:
    study.resume()
    study.without_participants()
    serving = asyncio.create_task(server.serve(sockets=[listener]))
    try:
        while not study.over:
            done, _ = await asyncio.wait([serving], timeout=LOOK_S)
            if done:
                break
        await asyncio.wait([serving], timeout=LOOK_S)  # the last pages say goodbye
    finally:
        study.close()
        server.should_exit = True
        with contextlib.suppress(asyncio.CancelledError):
            await serving


def _links(study: LiveStudy, origin: str) -> dict[Role, str]:
    roles: tuple[Role, ...] = ("participant", "demonstrator", "experimenter")
    return {role: f"{origin}/{LETTERS[role]}/{study.tokens.link(role)}" for role in roles}


def _qr(link: str) -> str:
    import io  # noqa: PLC0415  # only where a QR code is wanted

    drawn = io.StringIO()
    segno.make(link).terminal(drawn, compact=True)
    return drawn.getvalue()


def _public(origin: str | None) -> str | None:
    if origin is None:
        return None
    parts = urlsplit(origin)
    if parts.scheme not in {"http", "https"} or not parts.netloc or parts.path.strip("/"):
        raise InputError(f"--public-origin: {origin!r} is no origin; allowed: https://HOST[:PORT]")
    return f"{parts.scheme}://{parts.netloc}"


@contextlib.contextmanager
def _listening(address: Address):  # type: ignore[no-untyped-def]  # noqa: ANN202
    listener = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
    listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        listener.bind(("0.0.0.0" if address.lan else "127.0.0.1", address.port))  # noqa: S104
        listener.listen()  # before any link is printed: a browser that is quick only waits
    except (OSError, OverflowError) as error:
        listener.close()
        reason = getattr(error, "strerror", None) or str(error)
        raise InputError(
            f"--port: {address.port} cannot be used ({reason}); allowed: a free port"
        ) from None
    with contextlib.closing(listener):
        yield listener


def _lan_address() -> str:
    """Return this machine's address in the local network: that of the way out of it."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        try:
            probe.connect(("192.0.2.1", 9))  # nothing is sent
            return str(probe.getsockname()[0])
        except OSError:
            return socket.gethostbyname(socket.gethostname())
