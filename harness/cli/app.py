"""Joins the commands, and turns faulty input into one line and exit code 2."""

import errno
import signal
import sys
from contextlib import suppress
from importlib.metadata import version
from io import TextIOWrapper
from pathlib import Path
from typing import Annotated

import typer
from typer.exceptions import TyperException

from harness.cli import (
    benchmark,
    check,
    check_part,
    doctor,
    explain,
    export,
    imports,
    init,
    listing,
    live,
    open_report,
    power,
    preregister,
    recover,
    replay,
    report,
    reproduce,
    run,
    validate,
    watch,
)
from protocols.files.errors import InputError
from protocols.files.scalars import short

app = typer.Typer(
    name="lad-study",
    invoke_without_command=True,
    add_completion=True,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
    help=(
        "Run, simulate and analyse assistance studies on a simulated smart wheelchair.\n\n"
        "Start with `lad-study run`: the four-lap study with twelve synthetic participants, "
        "from the first lap to a report that opens in a browser.\n\n"
        "Exit codes: 0 done; 1 something failed, or nobody finished a lap of some condition; "
        "2 faulty input, with one line: where, "
        "what, and what is allowed."
    ),
)


def _print_version(asked: bool) -> None:
    if asked:
        typer.echo(f"lad-study {version('lad-study')}")
        raise typer.Exit


@app.callback()
def _options(
    context: typer.Context,
    _version: Annotated[
        bool,
        typer.Option(
            "--version", callback=_print_version, is_eager=True, help="Print the version."
        ),
    ] = False,
) -> None:
    """Take the options that come before a command; without a command, list the commands."""
    if context.invoked_subcommand is None:
        typer.echo(context.get_help())


app.command("init")(init.init)
app.command("run")(run.run)
app.command("live")(live.live)
app.command("watch")(watch.watch)
app.command("report")(report.report)
app.command("open")(open_report.open_report)
app.command("reproduce")(reproduce.reproduce)
app.command("benchmark")(benchmark.benchmark)
app.command("explain")(explain.explain)
app.command("replay")(replay.replay)
app.command("export")(export.export)
app.add_typer(imports.app, name="import")
app.command("power")(power.power)
app.command("preregister")(preregister.preregister)
app.command("validate")(validate.validate)
app.command("check")(check.check)
app.command("check-part")(check_part.check_part)
app.command("recover")(recover.recover)
app.command("doctor")(doctor.doctor)
app.command("protocols")(listing.protocols)
app.command("courses")(listing.courses)
app.command("show")(listing.show)


_IMPOSSIBLE_PATHS = (errno.ENAMETOOLONG, errno.ELOOP)
"""Errors of the system about a path that nothing can have: the path was an input."""

_INTERRUPTED = 130
"""What typer returns for a command that Ctrl-C has ended; no command here returns it."""


def main() -> None:
    """Run the command line and exit with its code."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):  # where a terminal knows ASCII alone
            stream.reconfigure(errors="backslashreplace")
    with suppress(ValueError):  # not in the main thread, where no signal can be asked for
        signal.signal(signal.SIGTERM, _stopped)
    try:
        _refuse_no_folder()
        code = app(prog_name="lad-study", standalone_mode=False)
    except InputError as fault:
        code = _say(str(fault), 2)
    except TyperException as fault:
        context = getattr(fault, "ctx", None)
        where = context.command_path if context else "lad-study"
        code = _say(f"{where}: {fault.format_message()}", 2)
    except KeyboardInterrupt:
        code = _INTERRUPTED
    except _TerminatedError:
        code = _say("lad-study: stopped by SIGTERM. What was finished is kept.", 143)
    except OSError as fault:
        said = f"lad-study: {fault.strerror or fault}: {short(str(fault.filename or ''), 200)}"
        code = _say(said.rstrip(": "), 2 if fault.errno in _IMPOSSIBLE_PATHS else 1)
    if code == _INTERRUPTED:
        code = _say("lad-study: stopped. What was finished is kept.", 1)
    sys.exit(code if isinstance(code, int) else 0)


def _refuse_no_folder() -> None:
    """Refuse to work where nothing can be found or put: the folder one is in was removed."""
    try:
        Path.cwd()
    except FileNotFoundError:
        raise InputError("the working directory is not there any more; go to another") from None


class _TerminatedError(BaseException):
    """The process was asked to end: what is open is closed, and nothing is left behind."""


def _stopped(_number: int, _frame: object) -> None:
    signal.signal(signal.SIGTERM, signal.SIG_DFL)  # a second one ends it at once
    raise _TerminatedError


def _say(message: str, code: int) -> int:
    sys.stderr.write(" ".join(message.split()) + "\n")
    return code
