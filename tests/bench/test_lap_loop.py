"""What the benchmark of the lap loop writes and prints."""

import json
import subprocess
import sys
from collections import Counter
from pathlib import Path
from types import SimpleNamespace

import pytest
from lap_loop import GRID, OURS, PARTS, REFERENCE, Row, find_simulators, print_table
from lap_loop_plot import plot
from time_split import _split

BENCH = Path(__file__).parents[2] / "bench"


def test_the_grid_has_every_size_and_the_reference() -> None:
    """20, 60 and 200 boxes, 15, 180 and 682 rays, 10 and 20 Hz: eighteen cells."""
    assert len(set(GRID)) == 18
    assert REFERENCE in GRID


def test_the_table_divides_ours_by_theirs(capsys: pytest.CaptureFixture[str]) -> None:
    """What stands in brackets is how many times the peer's speed ours is."""
    rows = [Row(OURS, 20, 15, 10, PARTS[0], 300.0), Row("peer", 20, 15, 10, PARTS[0], 120.0)]
    print_table(rows, PARTS[0])
    assert "| 20 | 15 | 10 | **300** | 120 (2.5) |" in capsys.readouterr().out


def test_an_absent_peer_is_reported_and_the_others_run(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """A simulator whose package is missing is named, with the reason, and left out."""
    monkeypatch.setitem(sys.modules, "mujoco", None)
    monkeypatch.delitem(sys.modules, "peers.mujoco_wheels", raising=False)
    monkeypatch.setattr("lap_loop.SIMULATORS", {OURS: "lad_study:LadStudy",
                                                "mujoco": "mujoco_wheels:MuJoCo"})  # fmt: skip
    assert list(find_simulators()) == [OURS]
    assert "mujoco: absent (" in capsys.readouterr().out


def test_the_split_counts_every_second_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """Stages and rest add up to the whole, and a stage inside another counts for the outer one."""
    now = [0.0]
    monkeypatch.setattr("time_split.time", SimpleNamespace(process_time=lambda: now[0]))

    class Work:
        def outer(self) -> None:
            self.inner()
            now[0] += 4.0

        def inner(self) -> None:
            now[0] += 2.0

    work, inner = Work(), Work.inner

    def run() -> None:
        work.outer()
        work.inner()
        now[0] += 1.0

    split = _split(run, ((Work, "outer", "physics"), (Work, "inner", "rays")))
    assert split == {"physics": 6.0, "rays": 2.0, "rest": 1.0}
    assert Work.inner is inner


def test_the_plot_is_the_same_for_the_same_rows(tmp_path: Path) -> None:
    """An SVG without dates or random names, so that a new one shows new results."""
    rows = [
        {"simulator": name, "boxes": cell.boxes, "rays": cell.rays, "rate_hz": cell.rate_hz,
         "part": part, "rtf": 10.0 + cell.boxes}
        for name in (OURS, "mujoco") for cell in GRID for part in PARTS
    ]  # fmt: skip
    for name in ("one.svg", "two.svg"):
        plot(rows, tmp_path / name)
    assert (tmp_path / "one.svg").read_bytes() == (tmp_path / "two.svg").read_bytes()


@pytest.mark.slow
def test_a_quick_run_writes_the_agreed_rows(tmp_path: Path) -> None:
    """The command runs as documented, and its rows have the agreed fields and names."""
    file = tmp_path / "rows.json"
    command = [sys.executable, BENCH / "lap_loop.py", "--quick", "--repetitions", "1"]
    done = subprocess.run(  # noqa: S603  # our own script
        [*command, "--json", file], check=True, capture_output=True, text=True
    )
    rows = json.loads(file.read_text())
    assert {tuple(row) for row in rows} == {
        ("simulator", "boxes", "rays", "rate_hz", "part", "rtf")
    }
    assert Counter(row["part"] for row in rows).keys() == set(PARTS)
    assert {OURS, "naive pybullet"} <= {row["simulator"] for row in rows}
    assert all(row["rtf"] > 0 for row in rows)
    assert "200 / 20 boxes" in done.stdout
