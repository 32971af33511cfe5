"""What `--full` runs: every variant, other courses, each replicate with its own model."""

from contextlib import contextmanager

import numpy as np
import pytest

from harness.reproduction import full
from harness.reproduction.full import COURSES, full_experiments, run_full
from lad.lad_assistant import LADAssistant
from protocols.files.errors import InputError
from protocols.load import load_course, resolve_study
from protocols.record.reader import open_study
from protocols.study import StudyProtocol
from protocols.variants import VARIANTS


@contextmanager
def unseen(_name):
    """Show nothing."""
    yield lambda _ended, _planned: None


def test_there_is_a_study_for_every_variant_and_course(tmp_path):
    """Robustness by variant, the default first; then generalisation by course; one seed."""
    planned = full_experiments(tmp_path, 5)
    places = [e.folder.relative_to(tmp_path / "studies").as_posix() for e in planned]
    assert places == [
        *(f"robustness/{v.name}" for v in VARIANTS),
        *(f"generalisation/{name}" for name in COURSES),
    ]
    assert {e.run.seed for e in planned} == {5}
    assert {e.run.study.protocol.cohort.participants for e in planned} == {16}


def test_every_protocol_is_valid_as_written(tmp_path):
    """What the record will say of these studies can be read again."""
    for experiment in full_experiments(tmp_path, 0):
        protocol = experiment.run.study.protocol
        data = protocol.model_dump(mode="json", by_alias=True)
        assert StudyProtocol.model_validate(data) == protocol
        assert str(tmp_path) not in str(data)


def test_variants_are_driven_with_the_same_noise(tmp_path):
    """Only the model differs: cohort, course, laps and conditions are the default's."""
    first, *others = [e.run.study for e in full_experiments(tmp_path, 0)][: len(VARIANTS)]
    for study in others:
        same = study.protocol.model_copy(
            update={n: getattr(first.protocol, n) for n in ("name", "title", "model")}
        )
        assert (same, study.course) == (first.protocol, first.course)


def test_a_course_of_ones_own_comes_last(tmp_path):
    """It is driven like the shipped ones; a shipped one's name is refused."""
    hall = load_course("ward-corridor").model_copy(update={"name": "hall"})
    last = full_experiments(tmp_path, 0, hall)[-1]
    assert last.folder == tmp_path / "studies" / "generalisation" / "hall"
    assert last.run.study.course == hall
    for name in ("lab-office", "ward-corridor"):
        with pytest.raises(InputError, match=name):
            full_experiments(tmp_path, 0, hall.model_copy(update={"name": name}))


def test_what_cannot_be_made_is_refused_before_anything_runs(tmp_path, monkeypatch):
    """A baseline whose library is missing stops the planning; nothing is written."""

    def without(choice, words=None):
        raise InputError(f"model {choice.use!r}: scikit-learn is not installed")

    monkeypatch.setattr(full, "make_model", without)
    with pytest.raises(InputError, match="scikit-learn"):
        full_experiments(tmp_path, 0)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.slow
def test_replicates_drive_elsewhere_with_the_models_their_laps_taught(tmp_path, monkeypatch):
    """On another course p(h) is what the replicate's saved model says of the recorded inputs."""
    monkeypatch.setattr(full, "resolve_study", lambda name: resolve_study(name, participants=2))
    every = {e.folder.name: e for e in full_experiments(tmp_path, 0)}
    planned = [every["default"], every["ward-corridor"]]
    said = []
    assert run_full(planned, 1, unseen, said.append) == ()
    taught, there = (open_study(e.folder) for e in planned)
    for participant in ("P0001", "P0002"):
        model = LADAssistant.from_bytes(taught.model_bytes(participant))
        steps = there.steps(participant, 3).to_pandas()
        model.start_lap()
        names = list(steps.columns[steps.columns.get_loc("user_v") :][:19])
        x = steps[names].to_numpy(dtype=np.float64)
        p = [model.assist(row).p_help for row in x[:100]]
        assert np.array_equal(p, steps["p_help"].to_numpy(dtype=np.float64)[:100])
    conditions = there.laps.to_pandas()["condition"].tolist()
    assert conditions == ["baseline", "limited", "demonstrator", "model"] * 2
