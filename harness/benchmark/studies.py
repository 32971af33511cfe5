"""The studies of a benchmark: one for every assistant in every setting, run one after another."""

from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass
from pathlib import Path

from harness.running.runner import Tell, run_study
from harness.session.model import make_model
from harness.session.study_run import StudyRun
from protocols.benchmark import DEMONSTRATIONS, SETTINGS, Setting, benchmark_protocol
from protocols.code_beside import PartBeside
from protocols.files.errors import InputError
from protocols.load import load_course
from protocols.model_choice import ModelChoice
from protocols.record.logs import failure_reason
from protocols.resolved import ResolvedStudy

Progress = Callable[[str], AbstractContextManager[Tell]]
"""Shows, under a study's name, how many of its sessions have ended."""


@dataclass(frozen=True, slots=True)
class Entry:
    """An assistant of a benchmark.

    Attributes
    ----------
    label
        Unique; usable as a folder's name.
    model
        As a protocol has it.
    """

    label: str
    model: ModelChoice


@dataclass(frozen=True, slots=True)
class Cell:
    """One assistant in one setting, and where its study is recorded."""

    entry: Entry
    setting: Setting
    run: StudyRun
    folder: Path


def entry_of(name: str, code: Sequence[PartBeside] = ()) -> Entry:
    """Return the assistant that a person names.

    Parameters
    ----------
    name
        A shipped model, or ``module:factory``; ``+evidence`` behind a shipped one asks for
        ``tune: evidence``.
    code
        Models of a person's own that may be run.

    Raises
    ------
    InputError
        When there is no such assistant, or it cannot be made.
    """
    use, plus, tune = name.partition("+")
    fields: dict[str, object] = {"use": use}
    if plus:
        fields["parameters"] = {"tune": tune}
    try:
        model = ModelChoice.model_validate(fields)
    except ValueError as error:
        reason = str(error).splitlines()[2].strip() if "\n" in str(error) else str(error)
        raise InputError(f"MODEL {name!r}: {reason}") from None
    make_model(model, code=code)
    return Entry(name.replace(":", "-").replace(".", "-"), model)


def plan(
    out: Path,
    names: Sequence[str],
    seed: int,
    replicates: int,
    *,
    settings: Sequence[Setting] = SETTINGS,
    demonstrations: tuple[int, ...] = DEMONSTRATIONS,
    code: Sequence[PartBeside] = (),
) -> tuple[Cell, ...]:
    """Return the studies of a benchmark, in the order to be run.

    In a setting in which nothing is demonstrated, each replicate's assistant is taught the
    demonstrations that the same replicate gave in the setting named by ``taught_on``.

    Parameters
    ----------
    out
        The benchmark's folder; each study has a folder in it, by setting and assistant.
    names
        Assistants as ``entry_of`` takes them.
    seed
        Of every study; 0 or more.
    replicates
        Participants of every study, 1 or more.
    settings, demonstrations
        As ``protocols.benchmark`` has them.
    code
        Models of a person's own that may be run.

    Raises
    ------
    InputError
        When an assistant is named twice or cannot be made, or a course cannot be used.
    """
    entries = [entry_of(name, code) for name in names]
    if len({entry.label for entry in entries}) < len(entries):
        raise InputError(f"MODEL: given twice in {' '.join(names)}; allowed: each once")
    cells = []
    for setting in settings:
        course = load_course(setting.course)
        for entry in entries:
            there = setting.taught_on and f"{setting.taught_on}/{entry.label}"
            protocol = benchmark_protocol(setting, entry.model, replicates, demonstrations, there)
            beside = tuple(part for part in code if part.use == entry.model.use)
            study = ResolvedStudy(protocol, course, (), folder=out, beside=beside, trusted=True)
            run = StudyRun(study, seed)
            cells.append(Cell(entry, setting, run, out / setting.name / entry.label))
    return tuple(cells)


def run_cells(
    cells: Sequence[Cell], jobs: int, progress: Progress, scheduler: str | None = None
) -> tuple[str, ...]:
    """Run what is missing of a benchmark; return a line for each study in which sessions failed.

    Raises
    ------
    InputError
        When a folder holds another study.
    OSError
        When something cannot be written; what was finished is kept.
    """
    lines = []
    for cell in cells:
        with progress(f"{cell.setting.name}, {cell.entry.label}") as tell:
            outcome = run_study(
                cell.run, cell.folder, jobs, tell, scheduler=scheduler, retry_failed=True
            )
        if outcome.failed:
            reason = failure_reason(cell.folder, outcome.failed[0])
            lines.append(
                f"{cell.folder}: {len(outcome.failed)} of {outcome.planned} sessions failed "
                f"({outcome.failed[0]}: {reason}); the same command runs them again"
            )
    return tuple(lines)
