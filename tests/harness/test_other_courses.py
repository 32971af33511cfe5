"""The courses beside the default one are what they say, and can be driven."""

import importlib.util
import math
import sys
from pathlib import Path

import numpy as np
import pytest
from ruamel.yaml import YAML

from protocols.course.centreline import Centreline
from protocols.course.obstacles import floor_plan, obstacle_boxes
from protocols.course.schema import Course
from protocols.load import load_course

BENCH = Path(__file__).parents[2] / "bench"
needs_checkout = pytest.mark.skipif(not BENCH.is_dir(), reason="needs the checkout")


def _script(name, monkeypatch):
    monkeypatch.syspath_prepend(str(BENCH))
    spec = importlib.util.spec_from_file_location(name, BENCH / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    monkeypatch.setitem(sys.modules, name, module)
    spec.loader.exec_module(module)
    return module


def _turns(course, kinds):
    """Return the heading's change over the sections of some kinds, degrees, by name."""
    line = Centreline(course)
    arcs = {s.name: np.linspace(s.start - 0.01, s.end + 0.01, 200)
            for s in line.sections if s.kind in kinds}  # fmt: skip
    headings = {n: np.unwrap([line.point(a).heading for a in at]) for n, at in arcs.items()}
    return {name: math.degrees(h[-1] - h[0]) for name, h in headings.items()}


def test_the_mirror_image_is_one():
    """Every obstacle of the default course stands in the mirror image, its y turned around."""
    plan = floor_plan(load_course("lab-office"))
    mirror = load_course("lab-office-mirror")
    original = obstacle_boxes(load_course("lab-office"))
    for ours, theirs in zip(obstacle_boxes(mirror), original, strict=True):
        flipped = [(x, -y) for x, y in ours.corners()]
        for corner in theirs.corners():
            assert min(math.dist(corner, other) for other in flipped) < 1e-9
    assert floor_plan(mirror).area == pytest.approx(plan.area, abs=1e-6)


def test_the_mirror_image_has_no_right_turn():
    """All four corners are left turns, two of them sharp: nothing there for the limitation."""
    mirror = load_course("lab-office-mirror")
    assert {s.kind for s in mirror.sections} == {"straight", "left"}
    turns = _turns(mirror, {"left"})
    assert all(turn > 30 for turn in turns.values())
    assert min(turns["L1"], turns["L2"]) > 100


def test_the_ward_has_every_kind_of_turn():
    """Sharp rights over 60 degrees, soft rights below, and left turns over 60 degrees."""
    ward = load_course("ward-corridor")
    sharp = _turns(ward, {"sharp_right"})
    soft, left = _turns(ward, {"soft_right"}), _turns(ward, {"left"})
    assert len(sharp) == len(soft) == len(left) == 2
    assert all(turn < -60 for turn in sharp.values())
    assert all(-60 < turn < -20 for turn in soft.values())
    assert all(turn > 60 for turn in left.values())


@needs_checkout
def test_the_mirror_file_is_what_its_script_writes(monkeypatch):
    """The mirror image of the default layout is the shipped file, exactly."""
    layout = _script("lay_out_course", monkeypatch)
    data = layout.lay_out(layout.LAB_OFFICE, "lab-office-mirror", "t", "d")
    written = _script("mirror_course", monkeypatch).mirrored(data)
    _same(written, "lab-office-mirror", but=("title", "description"))


@needs_checkout
def test_the_ward_file_is_what_its_script_writes(monkeypatch):
    """Legs, turns, rooms and furniture of the script lead to the shipped file, exactly."""
    _script("lay_out_course", monkeypatch)
    _same(_script("lay_out_ward", monkeypatch).lay_out(), "ward-corridor")


def _same(data, name, but=()):
    text = BENCH.parent / f"protocols/courses/{name}.yaml"
    shipped = Course.model_validate(YAML(typ="safe").load(text))
    written = Course.model_validate(data)
    assert written.model_copy(update={f: getattr(shipped, f) for f in but}) == shipped
