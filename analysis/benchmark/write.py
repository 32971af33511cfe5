"""Read a benchmark's studies, and write what they found: one table for people, one for programs."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import pandas as pd

from analysis.benchmark.measures import MEASURES, measures_of
from analysis.benchmark.ranking import cell_table, ranking
from protocols.record.atomic import write_whole
from protocols.record.reader import open_study

PAGE, CELLS, REPLICATES, COSTS = "benchmark.md", "cells.csv", "measures.csv", "costs.csv"


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


def write_costs(out: Path, costs: Mapping[str, float]) -> None:
    """Write ``costs.csv``: the CPU time of each assistant's look, us, and beside the first one's.

    It is a file of its own because the others are the same bytes in every run.

    Parameters
    ----------
    out
        The benchmark's folder.
    costs
        Microseconds, by assistant, in the order named.

    Raises
    ------
    OSError
        When it cannot be written.
    """
    frame = pd.DataFrame({"assistant": list(costs), "look_us": list(costs.values())})
    frame["beside_first"] = frame["look_us"] / frame["look_us"].iloc[0] if len(frame) else None
    write_whole(out / COSTS, frame.to_csv(index=False).encode())


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
    head = ("demonstrations", "assistant", "n", "lap, s (worst)", "minus demonstrator, s (worst)",
            "95%", "minus alone, s", "finished", "takeovers (most)", "chatter", "Brier own",
            "Brier demonstrated", "p at onset", "coverage", "log density",
            "help elsewhere")  # fmt: skip
    rows = [
        (
            str(c["demonstrations"]), c["assistant"], str(c["n"]),
            f"{c['lap_s']:.1f} ({c['worst_lap_s']:.1f})",
            f"{c['minus_demonstrator_s']:+.2f} ({c['worst_minus_demonstrator_s']:+.2f})",
            _interval(c["low"], c["high"]), f"{c['minus_alone_s']:.1f}", f"{c['finished']:.2f}",
            f"{c['takeovers']:.1f} ({c['worst_takeovers']:.0f})",
            *(_number(c[name], digits) for name, digits in _SHOWN),
        )
        for c in cells.to_dict("records")
    ]  # fmt: skip
    return f"### {setting}\n\n{_table(head, rows)}"


_SHOWN = (("chatter", 1), ("brier_own", 3), ("brier_demonstrated", 3), ("p_at_onset", 2),
          ("coverage_90", 2), ("log_density", 2), ("help_elsewhere", 3))  # fmt: skip


def _table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)


def _interval(low: float, high: float) -> str:
    return "–" if math.isnan(low) else f"{low:.2f} to {high:.2f}"


def _number(value: float, digits: int) -> str:
    return "–" if math.isnan(value) else f"{value:.{digits}f}"
