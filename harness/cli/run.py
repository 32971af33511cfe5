"""`lad-study run`: a study from its protocol to its report."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from harness.cli.console import complain, say
from harness.cli.options import check_least, cores
from harness.cli.reporting import write_report_of

if TYPE_CHECKING:
    from harness.running.runner import Outcome
    from protocols.registration import Registration
    from protocols.resolved import ResolvedStudy


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
    ] = cores(),
    scheduler: Annotated[
        str | None,
        typer.Option(metavar="ADDRESS", help="Run on a Dask cluster, e.g. tcp://host:8786."),
    ] = None,
    course: Annotated[
        str | None, typer.Option(help="Another course than the protocol's: a name or a file.")
    ] = None,
    registration: Annotated[
        Path | None,
        typer.Option(metavar="DIR", help="Follow this registration; another plan is refused."),
    ] = None,
    retry_failed: Annotated[
        bool, typer.Option("--retry-failed", help="Run sessions again that failed before.")
    ] = False,
    trust: Annotated[
        bool, typer.Option("--trust", help="Allow the code beside the protocol file, as it is now.")
    ] = False,
    no_report: Annotated[bool, typer.Option("--no-report", help="Only the record.")] = False,
) -> int:
    """Run a study with synthetic participants, and report it.

    Without arguments: the four-lap study, twelve participants, seed 0. A run that was stopped
    goes on where it was when the same command is given again. A protocol's own parts are code:
    they run with --trust only, and after that until their file changes. Exit code 1 when a session
    failed, or when nobody finished a lap of some condition.

    Example: lad-study run four-lap --participants 24 --seed 3 --out studies/pilot
    """
    check_least("--seed", seed, 0)
    check_least("--jobs", jobs, 1)
    folder, outcome = _run(
        protocol,
        participants,
        seed,
        out,
        jobs,
        scheduler,
        course,
        registration=registration,
        retry_failed=retry_failed,
        trust=trust,
    )
    if outcome.found:
        say(f"{outcome.found} of {outcome.planned} sessions were there already.")
    if not no_report and outcome.found + outcome.finished:
        _report(folder)
    unfinished = _what_nobody_finished(folder) if outcome.found + outcome.finished else ()
    for sentence in unfinished:
        complain(sentence)
    say(f"Study:  {folder}")
    if outcome.failed:
        complain(_failures(folder, outcome))
    return 1 if outcome.failed or unfinished else 0


def _run(
    protocol: str,
    participants: int | None,
    seed: int,
    out: Path | None,
    jobs: int,
    scheduler: str | None,
    course: str | None,
    *,
    registration: Path | None,
    retry_failed: bool,
    trust: bool,
) -> "tuple[Path, Outcome]":
    from harness.running.open_workers import warm_up_workers

    if scheduler is None:
        warm_up_workers()  # first: workers start while this process reads the protocol
    from harness.cli.progress import counted_sessions
    from harness.cli.trust import trusted_study
    from harness.running.runner import run_study
    from harness.session.study_run import StudyRun
    from protocols.load import resolve_study

    study = resolve_study(protocol, course=course, participants=participants)
    study = trusted_study(study, asked=trust)
    plan = None
    if registration is not None:
        from protocols.registered_study import copy_registration, registered
        from protocols.registration import read_registration

        plan = read_registration(registration)
        study = registered(study, plan)
    folder = out or Path("studies") / f"{study.protocol.name}-seed{seed}"
    if plan is not None:
        _amend(folder, study, seed, plan)
    with counted_sessions() as tell:
        outcome = run_study(
            StudyRun(study, seed),
            folder,
            jobs,
            tell,
            scheduler=scheduler,
            retry_failed=retry_failed,
        )
    if plan is not None:
        copy_registration(plan, folder)
    return folder, outcome


def _amend(folder: Path, study: "ResolvedStudy", seed: int, plan: "Registration") -> None:
    """Take over the plan's amendments where the study is under way, and say what was before."""
    from protocols.record.amendment import amend_study

    before = amend_study(folder, study, seed, plan)
    if before:
        number = len(plan.heads) - 1
        say(f"Amendment {number} takes effect: {len(before)} sessions were before it.")


def _failures(folder: Path, outcome: "Outcome") -> str:
    from protocols.record.store import failure_reason

    names = ", ".join(outcome.failed[:5]) + (", ..." if len(outcome.failed) > 5 else "")
    return (
        f"{len(outcome.failed)} of {outcome.planned} sessions failed ({names}; the first one: "
        f"{failure_reason(folder, outcome.failed[0])}): see {folder / 'logs'}; "
        "--retry-failed runs them again (those whose process died, the same command too)."
    )


def _what_nobody_finished(folder: Path) -> tuple[str, ...]:
    from analysis.unfinished import nobody_finished
    from protocols.record.reader import open_study

    return tuple(found.sentence for found in nobody_finished(open_study(folder)))


def _report(folder: Path) -> None:
    from harness.cli.lap_time_table import print_lap_times

    results, page = write_report_of(folder)
    print_lap_times(results)
    say(f"Report: {page}")
