"""`lad-study benchmark`: any assistant beside others, over settings, and a table that ranks."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from harness.cli.console import complain, say
from harness.cli.options import check_least, cores
from protocols.files.errors import InputError

if TYPE_CHECKING:
    from harness.benchmark.studies import Cell
    from protocols.benchmark import Setting

ASSISTANTS = ("lad-correction", "lad", "neighbours", "linear",
              "network-refitted")  # fmt: skip
"""Compared when none is named."""


def benchmark(
    models: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="[MODEL...]",
            help="Shipped models (+evidence: tuned) or module:factory.  "
            f"[default: {' '.join(ASSISTANTS)}]",
            show_default=False,
        ),
    ] = None,
    seed: Annotated[int, typer.Option(help="0 or more. Same seed, same bytes.")] = 2027,
    replicates: Annotated[int, typer.Option(help="Participants of each study, 1 or more.")] = 16,
    out: Annotated[
        Path | None,
        typer.Option(metavar="DIR", help="Where to.  [default: benchmarks/seedSEED]"),
    ] = None,
    setting: Annotated[
        list[str] | None, typer.Option(help="Only this one; may be given again.  [default: all]")
    ] = None,
    demonstrations: Annotated[
        str, typer.Option(metavar="N,N,...", help="Help in laps after so many demonstrations.")
    ] = "1,2,3,5",
    course: Annotated[
        str | None,
        typer.Option(metavar="FILE", help="A course of your own in place of each setting's."),
    ] = None,
    jobs: Annotated[
        int, typer.Option(help="Processes, 1 or more.", show_default="all cores")
    ] = cores(),
    scheduler: Annotated[
        str | None, typer.Option(metavar="ADDRESS", help="Dask scheduler, instead of --jobs.")
    ] = None,
    trust: Annotated[
        bool, typer.Option("--trust", help="Allow the code of a module here, as it is now.")
    ] = False,
) -> int:
    """Compare assistants over courses, limitations, drivers and demonstrators.

    Writes benchmark.md (a table that ranks, with paired intervals), cells.csv, measures.csv, and
    costs.csv: the CPU time of a look, which differs from run to run. A run that was stopped goes on
    where it was when the same command is given again.

    A model of your own is module:factory of a module in this folder; it runs with --trust only,
    and after that until its file changes.

    Example: lad-study benchmark lad-correction mine:make --trust --setting right --replicates 8
    """
    check_least("--seed", seed, 0)
    check_least("--replicates", replicates, 1)
    check_least("--jobs", jobs, 1)
    from harness.benchmark.studies import plan
    from harness.cli.trust import trust_code
    from protocols.parts import models_beside

    own = models_beside(models or (), Path.cwd())
    trust_code(own, asked=trust)
    folder = out or Path("benchmarks") / f"seed{seed}"
    cells = plan(
        folder.resolve(),
        models or ASSISTANTS,
        seed,
        replicates,
        settings=_settings(setting, course),
        demonstrations=_numbers(demonstrations),
        code=own,
    )
    return _benchmark(folder, cells, jobs, scheduler)


def _benchmark(folder: Path, cells: "Sequence[Cell]", jobs: int, scheduler: str | None) -> int:
    from harness.benchmark.studies import run_cells
    from harness.cli.progress import counted_sessions

    failures = run_cells(cells, jobs, counted_sessions, scheduler)
    for line in failures:
        complain(line)
    if failures:
        return 1
    from analysis.benchmark.write import Recorded, write_benchmark, write_costs
    from harness.benchmark.cost import step_costs

    studies = [
        Recorded(c.setting.name, c.entry.label, c.folder, _free_side(c.setting)) for c in cells
    ]
    page, ranks = write_benchmark(folder, studies)
    costs = step_costs(cells)
    write_costs(folder, costs)
    for row in ranks.to_dict("records"):
        place, who = f"{row['mean_rank']:5.2f}", row["assistant"]
        behind, finished = row["minus_demonstrator_s"], row["finished"]
        cost = f", {costs[who]:.0f} us a look" if who in costs else ""
        say(f"{place}  {who}: {behind:+.2f} s from the demonstrator, {finished:.1%} finished{cost}")
    say(f"Page: {page}")
    return 0


def _free_side(setting: "Setting") -> str | None:
    """Return the kind of section that the limitation leaves alone."""
    return None if "left_turn_rad_s" in setting.limitation else "left"


def _settings(names: Sequence[str] | None, course: str | None) -> "list[Setting]":
    from protocols.benchmark import SETTINGS

    by_name = {setting.name: setting for setting in SETTINGS}
    unknown = [name for name in names or () if name not in by_name]
    if unknown:
        raise InputError(f"--setting: {unknown[0]!r} is none; allowed: {', '.join(by_name)}")
    chosen = [by_name[name] for name in names] if names else list(SETTINGS)
    if course is not None:
        chosen = [replace(s, course=course) for s in chosen if s.taught_on is None]
    taught = {s.name for s in chosen}
    missing = [s for s in chosen if s.taught_on is not None and s.taught_on not in taught]
    if missing:
        raise InputError(
            f"--setting: {missing[0].name} needs what {missing[0].taught_on} has taught; "
            f"allowed: with --setting {missing[0].taught_on} too"
        )
    return chosen


def _numbers(text: str) -> tuple[int, ...]:
    try:
        numbers = tuple(int(part) for part in text.split(","))
    except ValueError:
        numbers = ()
    if not numbers or numbers[0] < 1 or list(numbers) != sorted(set(numbers)):
        raise InputError(
            f"--demonstrations: given {text!r}; allowed: rising whole numbers from 1, as in 1,3,5"
        )
    return numbers
