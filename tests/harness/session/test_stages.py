"""A session is the list of stages that its protocol asks for."""

from harness.session.parts import make_parts
from harness.session.session import Session
from harness.session.stages import stages_of


def kinds(run):
    """Return the kinds of a session's stages."""
    return [stage.kind for stage in stages_of(run.study.protocol, 1, run.seed)]


def test_stages_are_those_the_protocol_asks_for(every_stage, study_of):
    """Consent and particulars first, questions and a break after their lap, debriefing last."""
    assert kinds(every_stage) == [
        "consent", "demographics", "lap", "break", "lap", "lap", "questions", "debrief"
    ]  # fmt: skip
    bare = {
        "schema": 1, "name": "bare", "title": "Laps only", "conditions": {"a": {}},
        "laps": [{"condition": "a"}, {"condition": "a"}],
    }  # fmt: skip
    assert kinds(study_of(bare)) == ["lap", "lap"]


def test_a_session_goes_through_its_stages_one_by_one(every_stage, toy_world):
    """Running is a loop over the stages that are not over yet."""
    session = Session(every_stage, 1, toy_world, make_parts(every_stage, 1))
    for n, stage in enumerate(session.stages):
        assert session.done == n
        assert not session.over
        assert session.advance() == stage
    assert session.over
    assert session.run() == session.record()
    assert [lap.row.lap for lap in session.record().laps] == [0, 1, 2]


def test_who_does_not_agree_drives_nothing(every_stage, toy_world):
    """A refused consent ends the session; the record says so and holds nothing else."""

    class Refuses:
        def read(self, page):
            assert page.kind == "consent"
            assert page.text == "Do you agree?"
            return {"agreed": 0}

    parts = make_parts(every_stage, 1)
    session = Session(
        every_stage, 1, toy_world, type(parts)(parts.person, parts.lap, parts.respondent, Refuses())
    )
    record = session.run()
    assert record.laps == record.answers == ()
    assert not record.participant.consented
    assert record.participant.laps_driven == 0
    assert record.participant.laps_planned == 3


def test_no_demonstrator_and_no_respondent(study_of, toy_world):
    """A study may do without both: no shadow is recorded, and no question is asked."""
    run = study_of(
        {
            "schema": 1,
            "name": "alone",
            "title": "Alone",
            "cohort": {
                "driver": {"use": "autonomous"},
                "demonstrator": None,
                "respondent": None,
            },
            "conditions": {"a": {}},
            "laps": [{"condition": "a", "time_limit_s": 1}],
        }
    )
    parts = make_parts(run, 1)
    assert parts.lap.demonstrator is None
    assert parts.respondent is None
    record = Session(run, 1, toy_world, parts).run()
    steps = record.laps[0].steps
    assert steps["h_would"].null_count == len(steps) == 10
    assert record.answers == ()
