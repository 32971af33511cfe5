"""`lad-study run`: a study from its protocol to its report."""

import os
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    TextColumn,
    TimeElapsedColumn,
    TimeRemainingColumn,
)

from harness.cli.console import ERR, progress_line, say
from harness.cli.table import print_lap_times
from harness.plan import Plan
from protocols.errors import InputError
from protocols.load import resolve_study

if TYPE_CHECKING:  # at run time, only a run may load PyBullet
    from harness.runner import Outcome


def run(
    protocol: Annotated[
        str, typer.Argument(metavar="[PROTOCOL]", help="A shipped protocol's name, or a file.")
    ] = "four-lap",
    participants: Annotated[
        int | None, typer.Option(help="1 to 9999, in place of the protocol's own number.")
    ] = None,
    seed: Annotated[int, typer.Option(help="0 or more. Same seed, same bytes.")] = 0,
    out: Annotated[
        Path | None,
        typer.Option(help="Study directory.  [default: studies/PROTOCOL-seedSEED]"),
    ] = None,
    jobs: Annotated[
        int, typer.Option(help="Processes, 1 or more.", show_default="all cores")
    ] = os.cpu_count() or 1,
    scheduler: Annotated[
        str | None,
        typer.Option(metavar="ADDRESS", help="Run on a Dask cluster, e.g. tcp://host:8786."),
    ] = None,
    course: Annotated[
        str | None, typer.Option(help="Another course than the protocol's: a name or a file.")
    ] = None,
    retry_failed: Annotated[
        bool, typer.Option("--retry-failed", help="Run sessions again that failed before.")
    ] = False,
    no_report: Annotated[bool, typer.Option("--no-report", help="Only the record.")] = False,
) -> int:
    """Run a study with synthetic participants, and report it.

    Without arguments: the four-lap study, twelve participants, seed 0. A run that was stopped
    goes on where it was when the same command is given again.

    Example: lad-study run four-lap --participants 24 --seed 3 --out studies/pilot
    """
    _check("--seed", seed, 0)
    _check("--jobs", jobs, 1)
    study = resolve_study(protocol, course=course, participants=participants)
    folder = out or Path("studies") / f"{study.protocol.name}-seed{seed}"
    outcome = _run_with_progress(Plan(study, seed), folder, jobs, scheduler, retry_failed)
    if outcome.found:
        say(f"{outcome.found} of {outcome.planned} sessions were there already.")
    if not no_report and outcome.found + outcome.finished:
        _report(folder)
    say(f"Study:  {folder}")
    if outcome.failed:
        ERR.print(
            f"{len(outcome.failed)} of {outcome.planned} sessions failed "
            f"({', '.join(outcome.failed[:5])}{', ...' if len(outcome.failed) > 5 else ''}): "
            f"see {folder / 'logs'}; --retry-failed runs them again."
        )
        return 1
    return 0


def _check(option: str, value: int, least: int) -> None:
    if value < least:
        raise InputError(f"{option}: {value} is out of range; allowed: {least} or more")


def _run_with_progress(
    plan: Plan, folder: Path, jobs: int, scheduler: str | None, retry_failed: bool
) -> "Outcome":
    from harness.runner import run_study  # noqa: PLC0415  # loads PyBullet

    columns = (
        TextColumn("Sessions"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
        TextColumn("left"),
        TimeRemainingColumn(),
    )
    progress = Progress(*columns, console=ERR)

    def tell(ended: int, planned: int) -> None:
        if not progress.tasks:  # nothing is drawn before the input has been found right
            progress.add_task("Sessions", total=planned)
            progress.start()
        progress.update(progress.tasks[0].id, completed=ended)

    try:
        return run_study(plan, folder, jobs, tell, scheduler=scheduler, retry_failed=retry_failed)
    finally:
        if progress.tasks:
            progress.stop()


def _report(folder: Path) -> None:
    from analysis.report import write_report  # noqa: PLC0415  # slow to import, wanted here only

    with progress_line() as tell:
        page = write_report(folder, tell)
    print_lap_times(folder)
    say(f"Report: {page}")
