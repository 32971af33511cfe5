"""The studies of a benchmark: pairs, mistakes in one line, resumed to the same tables."""

import hashlib
from contextlib import contextmanager

import pytest
from typer.testing import CliRunner

from analysis.benchmark.write import Recorded, write_benchmark
from harness.benchmark.cost import step_costs
from harness.benchmark.studies import plan, run_cells
from harness.cli.app import app
from harness.session.study_run import portable
from protocols.benchmark import SETTINGS
from protocols.files.errors import InputError
from protocols.parts import models_beside

RIGHT = SETTINGS[:1]


@contextmanager
def silent(_label):
    """Show nothing."""
    yield lambda ended, planned: None


def test_all_assistants_meet_the_same_people(tmp_path):
    """Studies of one setting differ in the model and in nothing else."""
    one, other = plan(tmp_path, ["lad", "lad-correction"], 5, 2, settings=RIGHT)
    left, right = (c.run.study.protocol.model_dump() for c in (one, other))
    assert left.pop("model") != right.pop("model")
    assert left == right
    assert one.run.seed == other.run.seed == 5


def test_every_assistant_drives_elsewhere_with_what_it_was_taught(tmp_path):
    """Nearest neighbours have no file: each replicate's are taught from its own recorded laps."""
    cells = plan(tmp_path, ["lad", "neighbours"], 5, 2)
    elsewhere = [c for c in cells if c.setting.taught_on]
    assert [c.entry.label for c in elsewhere] == ["lad", "neighbours"]
    borrowed = [c.run.study.protocol.models["taught elsewhere"] for c in elsewhere]
    assert [b.path for b in borrowed] == ["right/lad", "right/neighbours"]
    assert {b.source for b in borrowed} == {"own laps"}
    assert len({c.folder for c in cells}) == len(cells)


@pytest.mark.parametrize(
    ("names", "part"),
    [
        (["nowhere.at:all"], "nowhere"),
        (["lad", "lad"], "given twice"),
        (["lad+guessing"], "evidence"),
        (["lda"], "lda"),
    ],
)
def test_assistants_that_do_not_exist_are_refused_in_one_line(tmp_path, names, part):
    """Before anything runs."""
    with pytest.raises(InputError) as fault:
        plan(tmp_path, names, 0, 1, settings=RIGHT)
    assert part in str(fault.value)
    assert "\n" not in str(fault.value)


@pytest.mark.parametrize(
    ("arguments", "part"),
    [
        (["--demonstrations", "3,1"], "rising whole numbers"),
        (["--demonstrations", "0"], "rising whole numbers"),
        (["--setting", "up"], "allowed: right, left"),
        (["--setting", "elsewhere"], "with --setting right too"),
        (["--replicates", "0"], "1 or more"),
    ],
)
def test_options_out_of_range_are_refused(arguments, part):
    """Where, what, and what is allowed."""
    result = CliRunner().invoke(app, ["benchmark", "lad", *arguments])
    assert isinstance(result.exception, InputError)
    assert part in str(result.exception)


OWN = """
class Idle:
    def start_lap(self): ...
    def assist(self, x): ...
"""


def test_a_model_of_ones_own_runs_only_when_it_is_trusted(tmp_path, monkeypatch):
    """A module in this folder is refused with its file; once trusted, workers may load it."""
    (tmp_path / "mine.py").write_text(OWN)
    monkeypatch.chdir(tmp_path)
    result = CliRunner().invoke(app, ["benchmark", "mine:Idle"])
    assert isinstance(result.exception, InputError)
    assert f"MODEL: 'mine:Idle' would run the code in {tmp_path / 'mine.py'}" in str(
        result.exception
    )
    own = models_beside(["lad", "mine:Idle"], tmp_path)
    _, mine = plan(tmp_path, ["lad", "mine:Idle"], 5, 1, settings=RIGHT, code=own)
    assert portable(mine.run).study.code == own
    assert [part.use for part in own] == ["mine:Idle"]


@pytest.mark.slow
def test_a_benchmark_stopped_and_enlarged_ends_with_the_same_tables(tmp_path):
    """Two replicates at once, or one first: the same bytes; the model helps in its lap."""
    tables = []
    for name, sizes in (("whole", [2]), ("resumed", [1, 2])):
        for size in sizes:
            cells = plan(
                tmp_path / name, ["lad-correction"], 5, size, settings=RIGHT, demonstrations=(1,)
            )
            assert run_cells(cells, 1, silent) == ()
        recorded = [Recorded(c.setting.name, c.entry.label, c.folder) for c in cells]
        page, ranks = write_benchmark(tmp_path / name, recorded)
        assert ranks["finished"].iloc[0] == 1.0
        assert step_costs(cells)["lad-correction"] > 0
        tables.append(hashlib.sha256(page.read_bytes()).hexdigest())
    assert tables[0] == tables[1]
