"""Corrections, latent h and several demonstrators: from a protocol to the record."""

import json

import numpy as np
import pytest

from harness.session.parts import make_every_part, make_parts
from harness.session.session import Session
from harness.session.study_run import StudyRun
from harness.world.bullet_world import BulletWorld
from lad.lad_assistant import LADAssistant
from protocols.files.errors import InputError
from protocols.load import load_course, resolve_study

LIMITED = {"limitation": {"right_turn_rad_s": 0.15}}
SHOWN = {**LIMITED, "assistant": "demonstrator", "training": True}
STUDY = {
    "schema": 1,
    "name": "ways",
    "title": "Ways of teaching",
    "cohort": {"participants": 1, "driver": {"use": "autonomous"}},
    "demonstrators": {"other": {"use": "attentive", "options": {"reaction_s": 0.0}}},
    "conditions": {
        "shown": SHOWN,
        "corrected": {
            **LIMITED,
            "assistant": "model",
            "training": True,
            "corrections": {"patience_s": 0.0, "tolerance": 0.0},
        },
        "not told": {**SHOWN, "latent_h": {"command_noise": 0.05}},
        "by another": {**SHOWN, "demonstrator": "other"},
    },
    "laps": [
        {"condition": "shown", "time_limit_s": 3},
        {"condition": "corrected", "time_limit_s": 12},
        {"condition": "not told", "time_limit_s": 12},
        {"condition": "by another", "time_limit_s": 12},
    ],
}


def plan(folder, **changes):
    """Write a protocol and read it."""
    path = folder / "ways.yaml"
    path.write_text(json.dumps({**STUDY, **changes}))
    return StudyRun(resolve_study(str(path)), 4)


@pytest.fixture(scope="module")
def laps(tmp_path_factory):
    """Return the laps of a session, and the model it left."""
    run, world = plan(tmp_path_factory.mktemp("ways")), BulletWorld(load_course("lab-office"))
    record = Session(run, 1, world, make_parts(run, 1)).run()
    return {lap.row.condition: lap for lap in record.laps}, record.model


def test_only_corrected_steps_are_learnt_and_have_an_h(laps):
    """In a lap of corrections h is +1 in the demonstrator's steps and missing in all others."""
    steps = laps[0]["corrected"].steps.to_pandas()
    hers = steps["control"] == "demonstrator"
    assert hers.any()
    assert not hers.all()
    assert (steps.loc[hers, "h"] == 1).all()
    assert steps.loc[~hers, "h"].isna().all()
    before, after = (laps[0][name].row.basis_vectors_when for name in ("shown", "corrected"))
    assert 0 < after - before <= hers.sum()
    assert laps[0]["corrected"].row.training


def test_the_inferred_h_stands_beside_the_true_one(laps):
    """In a lap without a signal both are recorded; elsewhere nothing is inferred."""
    steps = laps[0]["not told"].steps.to_pandas()
    assert steps["h_inferred"].notna().all()
    assert ((steps["h_inferred"] > 0.5) == (steps["h"] > 0)).mean() > 0.95
    assert laps[0]["shown"].steps["h_inferred"].null_count == len(laps[0]["shown"].steps)
    known = laps[0]["not told"].row.basis_vectors_how
    assert known >= laps[0]["corrected"].row.basis_vectors_how


def test_another_demonstrator_teaches_the_same_model(laps):
    """Who reacts at once takes over earlier, and the one model learns from both."""
    first = {
        name: int(np.flatnonzero(laps[0][name].steps["h"].to_numpy() > 0)[0])
        for name in ("not told", "by another")
    }
    assert first["by another"] < first["not told"]
    whens = [laps[0][name].row.basis_vectors_when for name in ("not told", "by another")]
    assert whens[1] >= whens[0]
    assert LADAssistant.from_bytes(laps[1]).when.n_basis == whens[1]


@pytest.mark.parametrize(
    ("condition", "part"),
    [
        ({**LIMITED, "assistant": "model", "corrections": {}}, "corrections need"),
        ({**SHOWN, "corrections": {}}, "corrections need assistant: model"),
        ({**LIMITED, "assistant": "model", "latent_h": {}}, "latent_h needs"),
        ({**SHOWN, "latent_h": {"command_noise": 9}}, "command_noise"),
        ({**SHOWN, "demonstrator": "othr"}, "did you mean 'other'|allowed: own, other"),
        ({**LIMITED, "assistant": "model", "training": True}, "or corrections"),
    ],
)
def test_what_cannot_be_taught_is_refused_in_one_line(tmp_path, condition, part):
    """Where, what, and what is allowed."""
    with pytest.raises(InputError, match=part):
        plan(tmp_path, conditions={**STUDY["conditions"], "shown": condition})


def test_further_demonstrators_are_simulated_and_have_names_of_their_own(tmp_path):
    """One seat, and own is the cohort's."""
    with pytest.raises(InputError, match="one seat"):
        plan(tmp_path, demonstrators={"other": {"use": "live"}})
    with pytest.raises(InputError, match="another name"):
        plan(tmp_path, demonstrators={"other": {}, "own": {}})
    run = plan(tmp_path, demonstrators={"other": {"options": {"pace": 7}}})
    with pytest.raises(InputError, match=r"demonstrators\.other\.options"):
        make_every_part(run)
