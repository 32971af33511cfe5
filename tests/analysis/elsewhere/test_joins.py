"""What other programs leave out or number otherwise: flow, exclusions, orders, replays."""

import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from PIL import Image

from analysis.flow import participants_flow
from analysis.frames import study_frames
from analysis.order import driven_orders
from analysis.replay import write_replay
from analysis.report.sections.people import people_section
from analysis.results import analyse
from analysis.unfinished import nobody_finished
from protocols.files.errors import InputError
from protocols.record.check import check_remarks, check_study
from protocols.record.reader import open_study


def with_column(table, name, values):
    """Return a table with other values in a column."""
    place = table.schema.get_field_index(name)
    return table.set_column(place, name, pa.array(values))


@pytest.fixture
def written(recorded, tmp_path):
    """Return a function that writes the clean study after a change to its tables."""

    def write(change=lambda study: None):
        study = recorded()
        change(study)
        return study.write(tmp_path / "study")

    return write


def test_the_clean_study_is_whole(written):
    """Nothing to say of it: no fault, no remark."""
    folder = written()
    assert check_study(folder) == ()
    assert check_remarks(folder) == ()


def test_nobody_was_planned(written):
    """A file without a number of participants has planned none, and nobody was not run."""
    flow = participants_flow(study_frames(open_study(written())))
    assert (flow.planned, flow.not_run, flow.recorded) == (None, 0, 3)


def test_practice_is_the_first_lap_of_its_condition_in_any_numbering(written, as_clean, read_study):
    """Laps from 1 without a practice column: the practised laps are not analysed."""

    def from_1(study):
        laps = study.tables["laps"].drop_columns(["practice"])
        study.tables["laps"] = with_column(laps, "lap", [n + 1 for n in laps["lap"].to_pylist()])
        study.tables["surveys"] = study.tables["surveys"].slice(0, 0)
        study.steps = {}

    folder = written(from_1)
    found = read_study(folder)
    times = [name for name in as_clean.numbers if name.startswith("time")]
    assert not set(times) & set(found.differs(as_clean))
    assert any("laps of assisted are practice by the plan" in word for word in found.words)
    assert check_study(folder) == ()
    assert len(check_remarks(folder)) == 3


def test_a_rule_is_applied_where_nobody_said_who_is_excluded(written):
    """By collisions in the laps; by contacts in the steps where laps do not say."""

    def unsaid(study):
        study.tables["participants"] = study.tables["participants"].select(["participant"])
        study.tables["laps"] = study.tables["laps"].drop_columns(["collisions"])

    frames = study_frames(open_study(written(unsaid)))
    assert participants_flow(frames).excluded == {"4 collisions; the protocol allows 3": 1}
    assert frames.exclusions.looked
    assert "the protocol's rules were applied" in frames.exclusions.remarks[0]


def test_a_rule_that_cannot_be_applied_is_not_called_met_by_nobody(written):
    """Without collisions in laps or steps nobody can tell; the page does not say that it can."""

    def unsaid(study):
        study.tables["participants"] = study.tables["participants"].select(["participant"])
        study.tables["laps"] = study.tables["laps"].drop_columns(["collisions"])
        study.steps = {}

    frames = study_frames(open_study(written(unsaid)))
    assert not frames.exclusions.looked
    assert "Whether 3 participants collided too often is not known" in frames.exclusions.remarks[1]


def test_a_rule_met_by_people_recorded_as_not_excluded_is_named(written):
    """The record counts, and the reader is told."""

    def all_in(study):
        people = study.tables["participants"]
        study.tables["participants"] = with_column(people, "excluded", [False] * 3)

    frames = study_frames(open_study(written(all_in)))
    assert len(frames.participants) == 3
    assert "04 (4 collisions; the protocol allows 3)" in frames.exclusions.remarks[0]


def test_orders_are_those_driven(written):
    """Counterbalanced laps: the plan's order is one participant's, and the other's is another."""

    def turned(study):
        laps = study.tables["laps"]
        conditions = laps["condition"].to_pylist()
        conditions[1:3] = conditions[2:0:-1]
        study.tables["laps"] = with_column(laps, "condition", conditions)
        study.tables["surveys"] = study.tables["surveys"].slice(0, 0)

    orders = driven_orders(study_frames(open_study(written(turned))))
    first = "assisted (practice)"
    assert orders == {(first, "assisted", "manual"): 1, (first, "manual", "assisted"): 1}


def test_a_condition_nobody_finished_has_a_likely_reason(written):
    """All ran into the time limit and came no farther than one gate: the way may be closed."""

    def stuck(study):
        laps = study.tables["laps"]
        done = [c != "manual" for c in laps["condition"].to_pylist()]
        laps = with_column(laps, "completed", done)
        ends = ["finished" if d else "time_limit" for d in done]
        laps = laps.append_column("end_reason", pa.array(ends))
        study.tables["laps"] = laps.append_column("gates_passed", pa.array([2 * d for d in done]))

    (found,) = nobody_finished(open_study(written(stuck)))
    assert found.sentence.startswith("Nobody finished a lap of manual (3 begun): 3 ended by the ti")
    assert "none came to G: likely the way there is closed to the chair" in found.reason


def test_a_replays_title_and_time_are_the_records(written, tmp_path):
    """Its speed is right at 200 Hz, with a pair of equal stamps and a gap; none without time."""

    def fast(study):
        n = 600
        t = [i / 200 for i in range(n // 2)] + [3 + i / 200 for i in range(n // 2)]
        t[7] = t[6]
        steps = pa.table({"t_s": t, "x_m": [1 + i / n for i in range(n)], "y_m": [0.8] * n})
        study.steps["01", "steps-1.parquet"] = steps
        still = with_column(steps, "t_s", [0.0] * n)
        study.steps["01", "steps-2.parquet"] = still

    folder, out = written(fast), tmp_path / "lap.gif"
    write_replay(folder, [("01", 1)], out)
    with Image.open(out) as gif:
        shown = []
        for i in range(gif.n_frames):
            gif.seek(i)
            shown.append(gif.info["duration"])
    assert min(shown) >= 20
    assert sum(shown) / 1000 == pytest.approx(4.5 / 2, abs=0.2)
    with pytest.raises(InputError, match="no times that go on"):
        write_replay(folder, [("01", 2)], tmp_path / "still.gif")
    assert not (tmp_path / "still.gif").exists()


def test_another_studys_figures_are_not_beside_it(written):
    """No table, no section and no column of the paper's; no map of positions in another frame."""
    folder = written(lambda study: None)
    path = folder / "sessions" / "01" / "steps-1.parquet"
    steps = pq.read_table(path)
    pq.write_table(with_column(steps, "x_m", [1000 * x for x in steps["x_m"].to_pylist()]), path)
    results = analyse(open_study(folder))
    assert results.paper.empty
    texts = [block.text for block in people_section(results).blocks if hasattr(block, "text")]
    assert any(text.startswith("Positions of 1 lap do not fit the course") for text in texts)


def test_answers_of_unknown_items_are_faults_and_those_of_the_whole_session_are_not(written):
    """`check` says of answers what the page says."""

    def odd(study):
        answers = study.tables["surveys"].to_pylist()
        answers[0]["item"] = "q99"
        after = answers[1] | {"lap": -1, "condition": "(session)"}
        study.tables["surveys"] = pa.Table.from_pylist([*answers, after])

    (fault,) = check_study(written(odd))
    assert fault.endswith("surveys.parquet: 1 rows of item 'q99'; allowed: q1")
