"""Puts the commands together, and turns a person's mistake into one line and exit code 2."""

import sys
from importlib.metadata import version
from pathlib import Path
from typing import Annotated

import typer
from typer.exceptions import TyperException

from harness.cli import (
    benchmark,
    check,
    explain,
    listing,
    recover,
    replay,
    report,
    reproduce,
    run,
    validate,
)
from protocols.files.errors import InputError

app = typer.Typer(
    name="lad-study",
    invoke_without_command=True,
    add_completion=False,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
    help=(
        "Run, simulate and analyse assistance studies on a simulated smart wheelchair.\n\n"
        "Start with `lad-study run`: the four-lap study with twelve synthetic participants, "
        "from the first lap to a report that opens in a browser.\n\n"
        "Exit codes: 0 done; 1 something failed; 2 your input, with one line that says where, "
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
        bool, typer.Option("--version", callback=_print_version, is_eager=True, help="Say which.")
    ] = False,
) -> None:
    """Hold the options that come before a command; without one, say what commands there are."""
    if context.invoked_subcommand is None:
        typer.echo(context.get_help())


app.command("run")(run.run)
app.command("report")(report.report)
app.command("reproduce")(reproduce.reproduce)
app.command("benchmark")(benchmark.benchmark)
app.command("explain")(explain.explain)
app.command("replay")(replay.replay)
app.command("validate")(validate.validate)
app.command("check")(check.check)
app.command("recover")(recover.recover)
app.command("protocols")(listing.protocols)
app.command("courses")(listing.courses)
app.command("show")(listing.show)


_INTERRUPTED = 130
"""What typer returns for a command that Ctrl-C has ended; no command of ours returns it."""


def main() -> None:
    """Run the command line and exit with its code."""
    sys.path.append(str(Path.cwd()))  # last, so that a folder there cannot hide what is installed
    try:
        code = app(prog_name="lad-study", standalone_mode=False)
    except InputError as fault:
        code = _say(str(fault), 2)
    except TyperException as fault:
        context = getattr(fault, "ctx", None)
        where = context.command_path if context else "lad-study"
        code = _say(f"{where}: {fault.format_message()}", 2)
    except KeyboardInterrupt:
        code = _INTERRUPTED
    except OSError as fault:
        code = _say(f"lad-study: {fault.strerror or fault}: {fault.filename or ''}".rstrip(": "), 1)
    if code == _INTERRUPTED:
        code = _say("lad-study: stopped. What was finished is kept.", 1)
    sys.exit(code if isinstance(code, int) else 0)


def _say(message: str, code: int) -> int:
    sys.stderr.write(" ".join(message.split()) + "\n")
    return code
