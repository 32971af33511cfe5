"""`lad-study power`: how many participants a declared study needs."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from harness.cli.console import progress_line, say
from harness.cli.options import check_least, cores
from protocols.files.errors import InputError

if TYPE_CHECKING:
    from protocols.resolved import ResolvedStudy

MOST_SIZES = 12


def power(
    protocol: Annotated[
        str, typer.Argument(metavar="PROTOCOL", help="A shipped protocol's name, or a file.")
    ],
    n: Annotated[
        str, typer.Option("--n", metavar="FROM:TO", help="Numbers of participants, such as 6:40.")
    ] = "6:40",
    pool: Annotated[
        int, typer.Option(help="Synthetic people to simulate and draw studies from.")
    ] = 400,
    from_study: Annotated[
        Path | None,
        typer.Option("--from", metavar="STUDY", help="Draw from this study's people instead."),
    ] = None,
    assume: Annotated[
        list[str] | None,
        typer.Option(metavar="TEXT", help="A stated effect: 'the model helps: -10%'. Repeatable."),
    ] = None,
    target: Annotated[float, typer.Option(help="The power that is wanted, 0.05 to 0.99.")] = 0.8,
    seed: Annotated[int, typer.Option(help="0 or more. Same seed, same bytes.")] = 0,
    out: Annotated[
        Path | None, typer.Option(help="Folder for page and pool.  [default: studies/NAME-power]")
    ] = None,
    json_file: Annotated[
        Path | None, typer.Option("--json", metavar="FILE", help="Also write the rows there.")
    ] = None,
    jobs: Annotated[
        int, typer.Option(help="Processes for the pool, 1 or more.", show_default="all cores")
    ] = cores(),
) -> int:
    """Compute the power of every declared analysis against the number of participants.

    People are simulated once, at the runner's speed, and resumed when stopped; studies are then
    drawn from them without replacement. State the effect where you can: an effect that is taken
    from the cohort is only as good as the cohort.

    Example: lad-study power four-lap --n 6:40 --assume "the model helps: -10%"
    """
    check_least("--seed", seed, 0)
    check_least("--jobs", jobs, 1)
    if not 0.05 <= target <= 0.99:
        raise InputError(f"--target: {target} is out of range; allowed: 0.05 to 0.99")
    from protocols.load import resolve_study
    from protocols.record.atomic import write_whole

    study = resolve_study(protocol)
    if not study.protocol.analyses:
        raise InputError(f"{protocol}: declares no analysis; allowed: a protocol with analyses")
    folder = out or Path("studies") / f"{study.protocol.name}-power"
    sizes = _sizes(n)
    if from_study is None:
        _refuse_more_than_a_quarter(sizes, pool)
        from_study = _simulated(study, pool, seed, folder / "pool", jobs)
    from analysis.frames import study_frames
    from analysis.power.assumptions import stated_effects
    from analysis.power.page import PowerStudy, power_json, write_power
    from analysis.power.pool import pool_of
    from analysis.power.power import power_rows
    from protocols.record.reader import open_study

    with progress_line() as tell:
        tell("Reading the pool")
        frames = study_frames(open_study(from_study))
        people = pool_of(frames, study.protocol.analyses)
        _refuse_more_than_a_quarter(sizes, people.size)
        effects = stated_effects(assume or (), study.protocol, people)
        tell("Drawing studies")
        rows = power_rows(study.protocol, people, sizes, effects, seed=seed)
        page = write_power(
            folder, PowerStudy(study.protocol, rows, people.size, frames.synthetic, target)
        )
        if json_file is not None:
            write_whole(json_file, power_json(rows).encode())
    _print(study, rows, target)
    say(f"Page: {page}")
    return 0


def _sizes(text: str) -> tuple[int, ...]:
    """Return at most ``MOST_SIZES`` numbers of participants, evenly from the first to the last."""
    first, _, last = text.partition(":")
    if not first.isdecimal() or not (last or first).isdecimal():
        raise InputError(f"--n: '{text}' is no range; allowed: such as 6:40, or one number")
    low, high = int(first), int(last or first)
    if not 2 <= low <= high:
        raise InputError(f"--n: {text} is out of range; allowed: 2 or more, the smaller one first")
    step = max(1, -(-(high - low) // (MOST_SIZES - 1)))
    return tuple(dict.fromkeys([*range(low, high, step), high]))


def _refuse_more_than_a_quarter(sizes: tuple[int, ...], people: int) -> None:
    if max(sizes) > people // 4:
        raise InputError(
            f"--n: {max(sizes)} participants are more than a quarter of a pool of {people}; "
            f"allowed: up to {people // 4}, or a larger pool"
        )


def _simulated(study: "ResolvedStudy", people: int, seed: int, out: Path, jobs: int) -> Path:
    """Simulate the pool, or what is missing of it."""
    from dataclasses import replace

    from harness.cli.progress import counted_sessions
    from harness.running.runner import run_study
    from harness.session.study_run import StudyRun

    cohort = study.protocol.cohort.model_copy(update={"participants": people})
    pool = replace(study, protocol=study.protocol.model_copy(update={"cohort": cohort}))
    with counted_sessions() as tell:
        run_study(StudyRun(pool, seed), out, jobs, tell)
    return out


def _print(study: "ResolvedStudy", rows: "tuple[object, ...]", target: float) -> None:
    from analysis.power.page import impossible_below
    from analysis.power.power import PowerRow, smallest_n

    kept = [row for row in rows if isinstance(row, PowerRow)]
    for analysis in study.protocol.analyses:
        n = smallest_n(kept, analysis.name, target)
        reached = f"{n} participants" if n is not None else "not reached"
        bound = impossible_below(study.protocol, analysis)
        say(f"{analysis.name}: power {target:g} with {reached}{bound}")
