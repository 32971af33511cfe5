"""The explanation finds what a policy was built to depend on, and maps moments to their laps."""

from types import SimpleNamespace

import numpy as np
import pandas as pd
import pyarrow as pa
import pytest

from analysis.explain.dependence import PAST, dependence
from analysis.explain.moments import leaned_on, unsure_sections
from analysis.explain.recorded import Looked, answers, learnt_model, looked_at
from analysis.explain.write import Explained, page
from lad.command import Command
from lad.correction import CorrectionAssistant
from lad.inputs import INPUT_NAMES
from lad.lad_assistant import LADAssistant
from protocols.files.errors import InputError

STEPS = 80


def inputs(rng):
    """Draw inputs that vary everywhere."""
    return np.concatenate([rng.uniform(-0.3, 0.3, 4), rng.uniform(0.5, 4.0, 15)])


def taught(make=LADAssistant, laps=2):
    """Teach help wherever the user pushes to the right, whatever else there is to see."""
    rng, model, seen = np.random.default_rng(0), make(), []
    for _ in range(laps):
        model.start_lap()
        own = []
        for _ in range(STEPS):
            x = inputs(rng)
            helping = x[1] < 0.0
            said = model.assist(x)
            model.learn(helping, Command(0.2, -0.5 + x[1]) if helping else None)
            own.append((x, helping, said.p_help, said.variance))
        seen.append(own)
    return model, seen


def table(own):
    """Return a lap's steps as recorded."""
    frame = pd.DataFrame([x for x, *_ in own], columns=list(INPUT_NAMES))
    frame["t_s"] = np.arange(len(own)) * 0.1
    frame["section"] = ["first" if i < STEPS // 2 else "second" for i in range(len(own))]
    frame["control"] = ["model" if helping else "driver" for _, helping, *_ in own]
    frame["p_help"] = [p for _, _, p, _ in own]
    frame["variance"] = [v for *_, v in own]
    return frame


def study(seen):
    """Return a stand-in for a recorded study."""
    laps = [
        {"participant": "P0001", "lap": i, "condition": "shown", "steps": STEPS, "training": True}
        for i in range(len(seen))
    ]
    return SimpleNamespace(
        folder="here",
        protocol=SimpleNamespace(conditions={}),
        laps=pa.Table.from_pandas(pd.DataFrame(laps)),
        steps=lambda _, lap, columns=None: pa.Table.from_pandas(
            table(seen[lap])[columns] if columns else table(seen[lap])
        ),
        model_bytes=lambda _: None,
    )


def test_windows_are_those_that_the_model_saw():
    """Answers at rebuilt windows are the answers of the lap itself, zeros before its start."""
    model, seen = taught()
    looked = looked_at(study(seen), "P0001", [1], 4)
    model.start_lap()
    direct = [model.assist(x) for x, *_ in seen[1]]
    p, commands = answers(model, looked.windows)
    assert p == pytest.approx([a.p_help for a in direct], abs=1e-12)
    assert commands == pytest.approx(np.array([a.mean for a in direct]), abs=1e-12)


@pytest.mark.parametrize("make", [LADAssistant, CorrectionAssistant])
def test_the_input_that_decides_comes_out_first(make):
    """Help depends on the stick's side alone: it has the largest change of p(h)."""
    model, seen = taught(make)
    looked = looked_at(study(seen), "P0001", [1], 4)
    found = dependence(model, looked, np.random.default_rng(0), repeats=4).set_index("input")
    when = found["when"].drop(PAST).sort_values(ascending=False)
    assert when.index[0] == "how far the user pushes to the side"
    assert when.iloc[0] > 1.1 * when.iloc[1]
    assert (found["when_low"] <= found["when"]).all()


def test_asking_teaches_nothing():
    """What was learnt is the same, to the last bit, after an explanation."""
    model, seen = taught()
    before = model.when.posterior(), model.how.posterior()
    looked = looked_at(study(seen), "P0001", [1], 4)
    dependence(model, looked, np.random.default_rng(0), repeats=2)
    for one, other in zip(before, (model.when.posterior(), model.how.posterior()), strict=True):
        for name in ("alpha", "C", "Q"):
            assert np.array_equal(getattr(one, name), getattr(other, name))


def test_moments_are_found_in_the_lap_they_were_shown_in():
    """A takeover in a step that was taught leans on that very step first."""
    model, seen = taught(laps=1)
    recorded = study(seen)
    looked = looked_at(recorded, "P0001", [0], 4)
    found = leaned_on(model, looked, recorded, "P0001", most=5)
    same = found[(found["shown_t_s"] == found["t_s"]) & (found["shown_lap"] == found["lap"])]
    assert (same["likeness"] > 0.999).all()
    assert len(same) > 0.5 * found.groupby(["lap", "t_s"]).ngroups


def test_sections_and_page():
    """Shares by section add up by hand; the page names the first inputs and the section."""
    model, seen = taught()
    looked = looked_at(study(seen), "P0001", [0, 1], 4)
    steps = looked.steps.assign(p_help=np.where(looked.steps["section"] == "first", 0.55, 0.9))
    sections = unsure_sections(model, Looked(looked.windows, steps)).set_index("section")
    assert sections.loc["first", "undecided"] == 1.0
    assert sections.loc["second", "undecided"] == 0.0
    assert sections["steps"].tolist() == [STEPS, STEPS]
    depends = dependence(model, looked, np.random.default_rng(0), repeats=2)
    moments = leaned_on(model, looked, study(seen), "P0001", most=1)
    text = page(Explained("P0001", depends, sections.reset_index(), moments), "x.png")
    assert "least sure in section first" in text


def test_nothing_learnt_is_said_in_one_line():
    """A session without a model has no policy to explain."""
    with pytest.raises(InputError, match="left no learnt model"):
        learnt_model(study(taught()[1]), "P0001")
