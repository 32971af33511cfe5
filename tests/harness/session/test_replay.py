"""The journal alone gives the session again, byte for byte."""

import pytest

from harness.session.journal import FileJournal
from harness.session.parts import make_parts
from harness.session.replay import replay
from harness.session.session import Session
from participants.driver import WithdrewError
from protocols.files.errors import InputError
from protocols.record.journal import journal_header, read_journal
from protocols.record.session import encode


@pytest.fixture
def journaled(every_stage, toy_world, tmp_path):
    """Return the record and the journal of a session of every kind of stage."""
    path = tmp_path / "P0001.jsonl"
    journal = FileJournal(path, journal_header(every_stage.study, every_stage.seed, "P0001"))
    parts = make_parts(every_stage, 1)
    record = Session(every_stage, 1, toy_world, parts, journal=journal).run()
    journal.close()
    return record, path


def again(run, world, path):
    """Replay a journal."""
    return replay(read_journal(path), run, 1, world)


def test_a_journal_changes_nothing(every_stage, toy_world, journaled):
    """With or without one, the record is the same."""
    without = Session(every_stage, 1, toy_world, make_parts(every_stage, 1)).run()
    assert encode(without) == encode(journaled[0])


def test_replaying_gives_the_same_bytes(every_stage, toy_world, journaled):
    """No person is asked again, and nothing differs: steps, rows, answers, model."""
    record, path = journaled
    assert encode(again(every_stage, toy_world, path)) == encode(record)


def test_an_unfinished_journal_ends_as_interrupted(every_stage, toy_world, journaled):
    """What was applied is there to the last step; the lap under way says why it ended."""
    record, path = journaled
    lines = path.read_bytes().splitlines(keepends=True)
    laps = [i for i, line in enumerate(lines) if b'"lap"' in line and line.startswith(b'{"stage"')]
    path.write_bytes(b"".join(lines[: laps[1] + 1 + 30]))
    cut = again(every_stage, toy_world, path)
    first, second = cut.laps
    assert first == record.laps[0]
    assert second.row.end_reason == "interrupted"
    assert second.row.stop_reason == "the journal ends here"
    assert second.row.lap_time_s is None
    assert second.steps == record.laps[1].steps.slice(0, 30)
    assert cut.answers == ()
    assert not cut.participant.completed


def test_a_journal_that_ends_between_stages_ends_the_session(every_stage, toy_world, journaled):
    """A session killed while questions were open has its laps and no answers."""
    record, path = journaled
    lines = path.read_bytes().splitlines(keepends=True)
    asked = next(i for i, line in enumerate(lines) if b'"questions"' in line)
    path.write_bytes(b"".join(lines[: asked + 1]))
    cut = again(every_stage, toy_world, path)
    assert cut.laps == record.laps
    assert cut.answers == ()


def test_a_withdrawal_is_replayed(every_stage, toy_world, tmp_path):
    """Why a participant left is in the journal, and in the record made from it."""

    class Leaves:
        def __init__(self, driver):
            self.driver = driver

        def start_lap(self, lap, rng):
            self.driver.start_lap(lap, rng)

        def act(self, sight):
            if sight.t > 1:
                raise WithdrewError("enough")
            return self.driver.act(sight)

    path, parts = tmp_path / "P0001.jsonl", make_parts(every_stage, 1)
    lap = type(parts.lap)(Leaves(parts.lap.driver), parts.lap.demonstrator, parts.lap.model)
    parts = type(parts)(parts.person, lap, parts.respondent, parts.reader)
    journal = FileJournal(path, journal_header(every_stage.study, every_stage.seed, "P0001"))
    record = Session(every_stage, 1, toy_world, parts, journal=journal).run()
    journal.close()
    assert record.laps[-1].row.withdrawal == "enough"
    assert encode(again(every_stage, toy_world, path)) == encode(record)


def test_a_journal_that_does_not_fit_is_named_by_its_line(every_stage, toy_world, journaled):
    """Entries in an order that no session has are refused, with the line."""
    _, path = journaled
    lines = path.read_bytes().splitlines(keepends=True)
    lines[1], lines[2] = lines[2], lines[1]
    path.write_bytes(b"".join(lines))
    with pytest.raises(InputError, match=r"jsonl:2: the session comes to 'stage'"):
        again(every_stage, toy_world, path)
