"""Whatever is in a file: valid and usable, or refused in one line; never a traceback or a wait.

A few hundred files in the short form, two thousand in the long one (``-m slow``).
"""

import importlib.util
import random
import time
from pathlib import Path

import pytest

from harness.session.parts import make_every_part
from harness.session.study_run import StudyRun, portable
from protocols.course.route import plan_route
from protocols.course.schema import Course
from protocols.files.dump import to_yaml
from protocols.files.errors import InputError
from protocols.instrument import Instrument
from protocols.load import check_file
from protocols.resolved import ResolvedStudy
from protocols.shipped import shipped_names, shipped_text

_SPEC = importlib.util.spec_from_file_location(
    "mutations", Path(__file__).with_name("mutations.py")
)
mutations = importlib.util.module_from_spec(_SPEC)
_SPEC.loader.exec_module(mutations)

HANGS = 5.0
"""Work on a file takes less, s."""

RICH = """\
schema: 1
name: rich
title: Everything at once
course: lab-office
cohort:
  participants: 3
  driver: {use: autonomous, options: {control_noise: 0.1}}
  demonstrator: {use: attentive, options: {pace: 0.9}}
  impairments:
    - {use: tremor, share: 0.3, severity: 0.5, options: {frequency_hz: 5}}
    - {use: weakness, share: 0.2, severity: 0.2}
  traits: {patience_s: {median: 120, spread: 0.5}}
conditions:
  baseline: {}
  shown: {limitation: {right_turn_rad_s: 0.15}, assistant: demonstrator, training: true}
  helped: {limitation: {right_turn_rad_s: 0.15}, assistant: model, arbitration: augment}
laps:
  - {condition: baseline, practice: true, time_limit_s: 20}
  - {condition: shown, survey: [{instrument: driving-assistance, items: [Q1, Q2]}]}
  - condition: helped
    survey: [{instrument: driving-assistance}]
model: {parameters: {capacity: 50, threshold: 0.4}}
exclusion: {min_completed_laps: 1}
analyses:
  - {name: a, condition: helped, reference: shown, kind: confirmatory, equivalence_margin: 2}
  - {name: b, outcome: driving-assistance.Q1, condition: helped, reference: shown}
control_period_s: 0.1
laser: {rays: 60, caster: sweep}
start_noise: {position_m: 0.05}
"""

KINDS = ("studies", "courses", "instruments")
ORIGINALS = {name: shipped_text(name) for kind in KINDS for name in shipped_names(kind)}
ORIGINALS["rich"] = RICH


def _used(checked):
    """Use what was found valid, as far as a run would before its first lap."""
    if isinstance(checked, ResolvedStudy):
        make_every_part(portable(StudyRun(checked, seed=0)), only_shipped=True)
        return checked.protocol
    if isinstance(checked, Course):
        assert len(plan_route(checked).gate_arcs) == len(checked.gates)
    return checked


def _tried(path):
    """Check a file; return what was refused, None when it is valid."""
    try:
        found = _used(check_file(str(path)))
    except InputError as error:
        return str(error)
    # Valid: written out in full, it is valid again and says the same.
    again = path.with_name("again.yaml")
    again.write_text(to_yaml(found), encoding="utf-8")
    checked = check_file(str(again))
    same = checked.protocol if isinstance(checked, ResolvedStudy) else checked
    assert type(same) is type(found)
    if not isinstance(checked, ResolvedStudy):
        assert same == found
    return None


@pytest.fixture(scope="module", autouse=True)
def compiled(tmp_path_factory):
    """Compile and import what a file needs, before anything is timed: a new checkout has to."""
    path = tmp_path_factory.mktemp("compiled") / "rich.yaml"
    path.write_text(RICH, encoding="utf-8")
    assert _tried(path) is None


def _try_many(folder, seed, count):
    rng = random.Random(seed)  # noqa: S311  # no secret
    refused = 0
    for i in range(count):
        name = rng.choice(sorted(ORIGINALS))
        content = mutations.mutated(ORIGINALS[name], rng)
        path = folder / f"{i}.yaml"
        path.write_bytes(content)
        begun = time.process_time()
        said = _tried(path)
        took = time.process_time() - begun
        assert took < HANGS, f"{name} {i}: {took:.1f} s"
        if said is not None:
            refused += 1
            assert "\n" not in said, content
            assert len(said) < 1600, content
            assert str(path.name) in said or "lad" in said or ":" in said, content
        path.unlink()
    return refused


def test_the_originals_are_valid(tmp_path):
    """What is going to be harmed is right before."""
    for name, text in ORIGINALS.items():
        path = tmp_path / f"{name}.yaml"
        path.write_text(text, encoding="utf-8")
        assert _tried(path) is None, name


@pytest.mark.parametrize("seed", range(3))
def test_a_harmed_file_is_usable_or_refused_in_one_line(tmp_path, seed):
    """The short form: three hundred files; most of them are broken, and are found to be."""
    assert _try_many(tmp_path, seed, 100) > 40


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(100, 120))
def test_two_thousand_harmed_files(tmp_path, seed):
    """The long form."""
    assert _try_many(tmp_path, seed, 100) > 40


FIELDS = {
    "driver": ["human", "autonomous", "os:system", "subprocess:run", "nobody", "a b", 7, None],
    "model": ["lad", "linear", "taught", "builtins:eval", "lad.trained:load", "", True],
    "control_period_s": [0.02, 0.5, 0.019, 0.51, -1, "0.1", True, float("nan")],
    "participants": [1, 9999, 0, 10000, 1.5, "3", True, None],
}
RIGHT = {
    "driver": {"human", "autonomous"},
    "model": {"lad", "linear"},
    "control_period_s": {0.02, 0.5},
    "participants": {1, 9999},
}


@pytest.mark.parametrize(("field", "value"), [(f, v) for f, vs in FIELDS.items() for v in vs])
def test_a_broken_value_is_never_accepted(tmp_path, field, value):
    """Every value of a field that is not right is refused, and every right one is not."""
    words = {"None": "null", "True": "true", "nan": ".nan"}
    written = words.get(repr(value), repr(value))
    text = RICH.replace("model: {parameters: {capacity: 50, threshold: 0.4}}\n", "")
    old, new = {
        "driver": ("{use: autonomous, options: {control_noise: 0.1}}", f"{{use: {written}}}"),
        "model": ("exclusion:", f"model: {{use: {written}}}\nexclusion:"),
        "control_period_s": ("control_period_s: 0.1", f"control_period_s: {written}"),
        "participants": ("participants: 3", f"participants: {written}"),
    }[field]
    assert old in text
    path = tmp_path / "f.yaml"
    path.write_text(text.replace(old, new))
    right = type(value) is not bool and value in RIGHT[field]
    assert (_tried(path) is None) == right


def test_an_instrument_is_an_instrument(tmp_path):
    """The kinds of file are told apart by their fields."""
    path = tmp_path / "q.yaml"
    path.write_text(ORIGINALS["driving-assistance"])
    assert isinstance(check_file(str(path)), Instrument)
