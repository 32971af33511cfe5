"""Models that others have taught may be of either shipped kind; own laps teach any assistant."""

import json
from types import SimpleNamespace

import numpy as np
import pyarrow as pa
import pytest

from harness.running.runner import run_study
from harness.session.borrowed import _restored, _teach, borrowed_models
from harness.session.study_run import StudyRun
from lad.command import Command
from lad.correction import CorrectionAssistant
from lad.inputs import INPUT_NAMES
from lad.lad_assistant import LADAssistant
from lad.trained import from_bytes
from protocols.files.errors import InputError
from protocols.load import resolve_study
from protocols.record.reader import open_study


@pytest.mark.parametrize("make", [LADAssistant, CorrectionAssistant])
def test_a_borrowed_model_is_what_it_was(make):
    """Its kind and its answers are those of the model that was saved."""
    model, x = make(), np.full(19, 0.3)
    model.start_lap()
    model.assist(x)
    model.learn(helping=True, command=Command(0.2, -0.5))
    borrowed = _restored(model.to_bytes(), "theirs")
    assert type(borrowed) is make
    for one in (model, borrowed):
        one.start_lap()
    said, again = model.assist(x), borrowed.assist(x)
    assert (said.mean, said.p_help, said.variance) == (again.mean, again.p_help, again.variance)


def test_what_is_no_model_is_named():
    """One line, with the protocol's name for it."""
    with pytest.raises(InputError, match="theirs"):
        _restored(b"nothing of the kind", "theirs")


SHOWN = {
    "limitation": {"right_turn_rad_s": 0.15},
    "assistant": "demonstrator",
    "training": True,
}
TAUGHT = {
    "schema": 1,
    "name": "taught",
    "title": "Taught",
    "cohort": {"participants": 2, "driver": {"use": "autonomous"}, "respondent": None},
    "conditions": {"shown": SHOWN, "seen": {**SHOWN, "training": False}},
    "laps": [
        {"condition": "shown", "time_limit_s": 12},
        {"condition": "seen", "time_limit_s": 3},
        {"condition": "shown", "time_limit_s": 12},
    ],
}
HELPED = {
    **TAUGHT,
    "name": "helped",
    "conditions": {"helped": {**SHOWN, "assistant": "model", "training": False, "model": "theirs"}},
    "laps": [{"condition": "helped", "time_limit_s": 3}],
    "models": {"theirs": {"from": "own laps", "path": "taught"}},
}


def plan(folder, protocol, use):
    """Write a protocol with another model, and read it."""
    path = folder / f"{protocol['name']}-{use}.yaml"
    path.write_text(json.dumps({**protocol, "model": {"use": use}}))
    return StudyRun(resolve_study(str(path)), 4)


@pytest.fixture(scope="module")
def taught(tmp_path_factory):
    """Return the folder in which two participants have taught a model in the study ``taught``."""
    folder = tmp_path_factory.mktemp("own")
    assert run_study(plan(folder, TAUGHT, "lad"), folder / "taught", 1).finished == 2
    return folder


def test_own_laps_teach_what_the_participant_has_taught(taught):
    """From the record comes the model that was saved: the same answers, bit for bit."""
    run = plan(taught, HELPED, "lad")
    for number in (1, 2):
        again = borrowed_models(run, number, world=None)["theirs"]
        saved = from_bytes(open_study(taught / "taught").model_bytes(f"P000{number}"))
        assert again.when.n_basis == saved.when.n_basis > 0
        assert again.how.n_basis == saved.how.n_basis > 0
        for one in (again, saved):
            one.start_lap()
        for x in np.random.default_rng(number).normal(0.3, 0.3, (20, 19)):
            assert again.assist(x) == saved.assist(x)


def test_own_laps_teach_an_assistant_that_cannot_be_saved(taught):
    """Nearest neighbours, taught from the record, help where help was shown."""
    model = borrowed_models(plan(taught, HELPED, "neighbours"), 1, world=None)["theirs"]
    steps = open_study(taught / "taught").steps("P0001", 0).to_pandas()
    model.start_lap()
    inputs = np.ascontiguousarray(steps[list(INPUT_NAMES)].to_numpy())
    said = np.array([model.assist(x).p_help for x in inputs])
    helped = steps["h"].to_numpy() > 0
    assert helped.any()
    assert np.mean((said >= 0.5) == helped) > 0.9


def test_who_had_no_lap_there_is_named(taught):
    """One line, with the folder and the participant."""
    with pytest.raises(InputError, match=r"taught: no training lap of P0007"):
        borrowed_models(plan(taught, HELPED, "lad"), 7, world=None)


def test_a_record_without_the_users_command_teaches_no_correction():
    """A correction is of the user's command: the lap is named, and nothing of it is learnt."""
    n = 30
    columns = {name: np.full(n, 0.3) for name in INPUT_NAMES}
    columns |= {"user_w": np.full(n, np.nan), "h": np.ones(n), "a_v": np.zeros(n)}
    steps = pa.table({**columns, "a_w": np.zeros(n)})
    study = SimpleNamespace(folder="elsewhere", steps=lambda *_: steps)
    model = CorrectionAssistant()
    before = model.to_bytes()
    with pytest.raises(InputError, match="elsewhere: P0001, lap 2: inputs or h were not recorded"):
        _teach(model, study, "P0001", 2, corrected=False)
    assert model.to_bytes() == before
