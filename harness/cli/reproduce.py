"""`lad-study reproduce`: the paper's experiments, and one page that compares both."""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from harness.cli.console import complain, progress_line, say
from harness.cli.options import check_least, cores
from protocols.files.errors import InputError

if TYPE_CHECKING:
    from analysis.report.blocks import Section
    from analysis.reproduction.row import Row
    from analysis.reproduction.write import Further
    from harness.reproduction.studies import Experiment
    from protocols.course.schema import Course


def reproduce(
    seed: Annotated[int, typer.Option(help="0 or more. Same seed, same bytes.")] = 0,
    out: Annotated[
        Path | None,
        typer.Option(metavar="DIR", help="Where to.  [default: reproductions/seedSEED]"),
    ] = None,
    jobs: Annotated[
        int, typer.Option(help="Processes, 1 or more.", show_default="all cores")
    ] = cores(),
    full: Annotated[
        bool, typer.Option("--full", help="Also robustness, baselines and other courses.")
    ] = False,
    why: Annotated[
        bool, typer.Option("--why", help="Also declared explanations of what differs, run.")
    ] = False,
    course: Annotated[
        str | None,
        typer.Option(metavar="FILE", help="With --full: a further course, a name or a file."),
    ] = None,
) -> int:
    """Run the paper's experiments, and compare the results with its numbers.

    Writes reproduction.html (one page), .md and .json (one row per quantity, with a verdict where
    a tolerance was declared). The same command resumes a run that was
    stopped.

    Example: lad-study reproduce --seed 1 --out reproductions/one
    """
    check_least("--seed", seed, 0)
    check_least("--jobs", jobs, 1)
    if course is not None and not full:
        raise InputError("--course: given without --full; allowed: only with --full")
    folder = out or Path("reproductions") / f"seed{seed}"
    return _reproduce(folder, seed, jobs, course, full=full, why=why)


def _reproduce(
    folder: Path, seed: int, jobs: int, course: str | None, *, full: bool, why: bool
) -> int:
    from harness.running.open_workers import warm_up_workers

    warm_up_workers()  # first: workers start while this process reads the protocols
    from harness.cli.progress import counted_sessions
    from harness.reproduction.studies import experiments, run_experiments
    from protocols.load import load_course

    chosen = None if course is None else load_course(course)
    planned = experiments(folder, seed)
    further = _further_experiments(folder, seed, chosen, full=full, why=why)
    failures = run_experiments(folder, planned, jobs, counted_sessions)
    if further and not failures:
        failures = _run_further(further, jobs)
    for line in failures:
        complain(line)
    if failures:
        return 1
    _write(folder, jobs, full=full, why=why)
    return 0


def _further_experiments(
    folder: Path, seed: int, course: "Course | None", *, full: bool, why: bool
) -> "tuple[Experiment, ...]":
    from harness.reproduction.full import full_experiments
    from harness.reproduction.why import why_experiments

    explanations = why_experiments(folder, seed) if why else ()
    return (*(full_experiments(folder, seed, course) if full else ()), *explanations)


def _run_further(planned: "Sequence[Experiment]", jobs: int) -> tuple[str, ...]:
    from harness.cli.progress import counted_sessions
    from harness.reproduction.full import run_full

    return run_full(planned, jobs, counted_sessions, complain)


def _write(folder: Path, jobs: int, *, full: bool, why: bool) -> None:
    from analysis.reproduction.write import write_reproduction
    from harness.cli.reproduction_table import print_rows

    with progress_line() as tell:
        further = _further_sections(jobs, tell, full=full, why=why) if full or why else None
        page, rows = write_reproduction(folder, jobs, tell, further)
    print_rows(rows)
    say(f"Page: {page}")


def _further_sections(
    jobs: int, tell: "Callable[[str], None]", *, full: bool, why: bool
) -> "Further":
    from analysis.reproduction.full import full_sections
    from analysis.reproduction.why import why_section, why_table

    def sections(folder: Path) -> "tuple[Sequence[Section], Sequence[Row]]":
        added, rows = full_sections(folder, jobs, tell) if full else ((), ())
        return (*added, *([why_section(why_table(folder))] if why else ())), rows

    return sections
