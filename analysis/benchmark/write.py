"""Read a benchmark's studies, and write what they found: one table for people, one for programs."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import pandas as pd

from analysis.benchmark.measures import MEASURES, measures_of
from analysis.benchmark.ranking import cell_table, ranking
from protocols.record.atomic import write_whole
from protocols.record.reader import open_study

PAGE, CELLS, REPLICATES = "benchmark.md", "cells.csv", "measures.csv"


@dataclass(frozen=True, slots=True)
class Recorded:
    """One study of a benchmark: who, where, and its folder."""

    setting: str
    assistant: str
    folder: Path
    free_side: str | None = "left"


def write_benchmark(out: Path, studies: Sequence[Recorded]) -> tuple[Path, pd.DataFrame]:
    """Write ``benchmark.md``, ``cells.csv`` and ``measures.csv``; return the page and the ranking.

    Parameters
    ----------
    out
        The benchmark's folder.
    studies
        What was run.

    Raises
    ------
    InputError
        When a study cannot be read.
    OSError
        When something cannot be written.
    """
    measures = pd.concat(
        [
            measures_of(open_study(study.folder), study.free_side).assign(
                setting=study.setting, assistant=study.assistant
            )
            for study in studies
        ],
        ignore_index=True,
    )
    cells, ranks = cell_table(measures), ranking(measures)
    write_whole(out / REPLICATES, measures.to_csv(index=False).encode())
    write_whole(out / CELLS, cells.to_csv(index=False).encode())
    write_whole(out / PAGE, page(cells, ranks).encode())
    return out / PAGE, ranks


def page(cells: pd.DataFrame, ranks: pd.DataFrame) -> str:
    """Return the benchmark as Markdown."""
    parts = ["# Benchmark of assistants", "## Ranking", _ranks(ranks), "## By setting"]
    parts += [_cells(str(setting), part) for setting, part in cells.groupby("setting", sort=False)]
    parts += ["## Measures", "\n".join(f"- `{name}`: {what}" for name, what in MEASURES.items())]
    return "\n\n".join(parts) + "\n"


def _ranks(ranks: pd.DataFrame) -> str:
    head = ("assistant", "mean rank", "cells", "minus demonstrator, s", "finished",
            "slower than the first, s", "95%", "pairs")  # fmt: skip
    rows = [
        (
            r["assistant"], f"{r['mean_rank']:.2f}", str(r["cells"]),
            f"{r['minus_demonstrator_s']:.2f}", f"{r['finished']:.3f}", f"{r['slower_s']:.2f}",
            _interval(r["low"], r["high"]), str(r["pairs"]),
        )
        for r in ranks.to_dict("records")
    ]  # fmt: skip
    return _table(head, rows)


def _cells(setting: str, cells: pd.DataFrame) -> str:
    head = ("demonstrations", "assistant", "n", "minus demonstrator, s", "95%", "minus alone, s",
            "finished", "takeovers", "chatter", "Brier own", "Brier demonstrated", "p at onset",
            "coverage", "log density", "help elsewhere")  # fmt: skip
    rows = [
        (
            str(c["demonstrations"]), c["assistant"], str(c["n"]),
            f"{c['minus_demonstrator_s']:.2f}", _interval(c["low"], c["high"]),
            f"{c['minus_alone_s']:.1f}", f"{c['finished']:.2f}",
            *(_number(c[name], digits) for name, digits in _SHOWN),
        )
        for c in cells.to_dict("records")
    ]  # fmt: skip
    return f"### {setting}\n\n{_table(head, rows)}"


_SHOWN = (("takeovers", 1), ("chatter", 1), ("brier_own", 3), ("brier_demonstrated", 3),
          ("p_at_onset", 2), ("coverage_90", 2), ("log_density", 2),
          ("help_elsewhere", 3))  # fmt: skip


def _table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)


def _interval(low: float, high: float) -> str:
    return "–" if math.isnan(low) else f"{low:.2f} to {high:.2f}"


def _number(value: float, digits: int) -> str:
    return "–" if math.isnan(value) else f"{value:.{digits}f}"
