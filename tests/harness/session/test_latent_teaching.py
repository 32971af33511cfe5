"""A lap of which the model is not told when help was given."""

import numpy as np
import pyarrow as pa
import pytest

from analysis.measures.discrimination import area_under_roc
from harness.session.latent_teaching import teach_inferred
from lad.command import Command
from lad.correction import CorrectionAssistant
from lad.inputs import INPUT_NAMES
from protocols.condition import LatentHelp
from protocols.record.steps import STEP_COLUMNS, STEP_SCHEMA

HELP = slice(60, 95)


def lap(n=200):
    """Return the steps of a lap in which help turns right by 0.35 rad/s more, in one stretch."""
    rng = np.random.default_rng(3)
    stick = [rng.uniform(0.2, 0.4, n), rng.uniform(-0.15, 0.0, n)]
    rest = [rng.uniform(0.2, 0.4, (n, 2)), rng.uniform(1, 4, (n, 15))]
    inputs = np.column_stack([*stick, *rest])
    counted = inputs[:, :2].copy()
    counted[HELP] += -0.1, -0.35
    columns = dict(zip(INPUT_NAMES, inputs.T, strict=True))
    columns |= {"arbitrated_v": counted[:, 0], "arbitrated_w": counted[:, 1]}
    nothing = {c.name: pa.nulls(n, c.type) for c in STEP_COLUMNS}
    return pa.table({**nothing, **columns}, schema=STEP_SCHEMA)


class Pupil:
    """Keeps what it is taught."""

    def __init__(self):
        self.laps, self.learnt, self.saw = 0, [], []

    def start_lap(self):
        self.laps += 1

    def assist(self, x):
        self.saw.append(x)

    def learn(self, helping, command):
        self.learnt.append((helping, command))


def test_at_the_stated_noise_the_inferred_h_is_the_true_one():
    """AUC of at least .99 with a command noise of .1, and the h is in the record."""
    true = np.zeros(200, dtype=bool)
    true[HELP] = True
    for seed in range(5):
        steps = teach_inferred(
            Pupil(), lap(), LatentHelp(command_noise=0.1), np.random.default_rng(seed)
        )
        inferred = steps["h_inferred"].to_numpy()
        assert area_under_roc(inferred, true) >= 0.99
    assert steps.schema == STEP_SCHEMA


def test_it_is_taught_every_step_once_with_what_counted():
    """Each step, in order: help with the command that counted, no help without a command."""
    pupil = Pupil()
    teach_inferred(pupil, lap(), LatentHelp(), np.random.default_rng(0))
    assert pupil.laps == 1
    assert [helping for helping, _ in pupil.learnt] == [60 <= i < 95 for i in range(200)]
    steps = lap().to_pandas()
    assert pupil.learnt[60][1] == Command(steps.arbitrated_v[60], steps.arbitrated_w[60])
    assert pupil.learnt[0][1] is None
    np.testing.assert_array_equal(np.array(pupil.saw), steps[list(INPUT_NAMES)].to_numpy())


def test_a_lap_too_short_to_infer_from_teaches_nothing():
    """Fewer than 20 steps: no h is made up, and the model is what it was."""
    pupil, short = Pupil(), lap().slice(0, 19)
    assert teach_inferred(pupil, short, LatentHelp(), np.random.default_rng(0)) == short
    assert (pupil.laps, pupil.learnt) == (0, [])


def test_the_same_seed_teaches_the_same_model():
    """The error of the command that counted is drawn from the lap's own random numbers."""
    models = []
    for seed in (1, 1, 2):
        model = CorrectionAssistant()
        rng = np.random.default_rng(seed)
        teach_inferred(model, lap(), LatentHelp(command_noise=0.1), rng)
        models.append(model.to_bytes())
    assert models[0] == models[1] != models[2]
    assert CorrectionAssistant.from_bytes(models[0]).how.n_basis == pytest.approx(35, abs=34)
