"""A map and a route become a course that can be driven."""

import math
import re

import numpy as np
import pytest
import shapely
from PIL import Image

from protocols.course.drivable import undrivable
from protocols.course.obstacles import floor_plan
from protocols.files.dump import to_yaml
from protocols.files.errors import InputError
from protocols.importing.map.bends import bends, doubling_back
from protocols.importing.map.course import import_course
from protocols.importing.map.draft import draft_route
from protocols.importing.map.ros_map import read_map
from protocols.importing.map.route import Route
from protocols.importing.mapping_file import read_mapping
from protocols.load import load_course
from protocols.shipped import shipped_text


@pytest.fixture
def bring_in(draw_course, route, tmp_path):
    """Return the function that imports lab-office, drawn as a map, with changes of the route."""

    def run(**changes):
        return import_course(read_map(draw_course(tmp_path)), route(**changes))

    return run


def test_walls_stand_where_the_map_has_them(bring_in):
    """No face of a wall is farther from the drawn course's than cell, closing and tolerance."""
    done = bring_in()
    drawn, found = _room(load_course("lab-office")), _room(done.course)
    seen = shapely.LineString(done.course.centreline).buffer(1.0)
    for there, here in ((drawn, found), (found, drawn)):
        faces = shapely.segmentize(shapely.intersection(there.boundary, seen), 0.05)
        points = shapely.points(shapely.get_coordinates(faces))
        assert len(points) > 50
        assert shapely.distance(points, here.boundary).max() < 0.05 + 0.06 + 0.06


def _room(course):
    """Return the free floor around a course's start; slits narrower than 14 cm are no floor."""
    plan = floor_plan(course)
    free = shapely.box(-20, -20, 20, 20).difference(plan).buffer(-0.07).buffer(0.07)
    return next(p for p in shapely.get_parts(free) if p.covers(shapely.Point(0, 0)))


def test_the_course_can_be_driven_and_loads_again(bring_in, tmp_path):
    """It passes the checks of every course file, the chair fits, and gates are named as asked."""
    done = bring_in()
    assert undrivable(done.course) is None
    assert done.too_tight == ()
    assert [gate.name for gate in done.course.gates] == ["R1", "R2", "F"]
    (tmp_path / "course.yaml").write_text(to_yaml(done.course))
    assert load_course(str(tmp_path / "course.yaml")) == done.course


def test_right_turns_are_the_courses(bring_in):
    """Both corners of lab-office are sharp rights."""
    kinds = [bend.kind for bend in bring_in().bends]
    assert kinds.count("sharp_right") == 2
    assert kinds.count("soft_right") >= 1


def test_the_description_records_how_walls_were_simplified(bring_in):
    """Map, checksum, tolerance and how many corners are left."""
    text = bring_in(gates="gates: [R1, R2, F]\nsimplify: {tolerance_m: 0.09}").course.description
    assert "within 0.09 m of the map's" in text
    assert re.search(r"SHA-256 [0-9a-f]{64}", text)
    before, after = map(int, re.search(r"(\d+) corners became (\d+)", text).groups())
    assert after < before / 5


def test_a_via_without_a_gate_only_leads_the_route(bring_in):
    """The route passes the point; no gate stands there."""
    course = bring_in(gates="gates: [null, R2, F]").course
    assert [gate.name for gate in course.gates] == ["R2", "F"]
    assert shapely.LineString(course.centreline).distance(shapely.Point(2.3, -0.4)) < 0.15


def test_a_turned_map_gives_the_same_course_turned(draw_course, route, tmp_path):
    """Origin's yaw: the world is turned by it, with start and points."""
    path = draw_course(tmp_path)
    straight = import_course(read_map(path), route()).course
    head = path.read_text()
    x, y = map(float, re.search(r"origin: \[(\S+), (\S+), 0.0\]", head).groups())
    yaw = 0.5

    def turned(px, py):
        return (
            x + math.cos(yaw) * (px - x) - math.sin(yaw) * (py - y),
            y + math.sin(yaw) * (px - x) + math.cos(yaw) * (py - y),
        )

    path.write_text(head.replace(", 0.0]", f", {yaw}]"))
    sx, sy = turned(0, 0)
    places = [turned(*p) for p in ((2.3, -0.4), (-2.95, -5.53), (-0.5, 0.0))]
    again = import_course(
        read_map(path),
        route(
            start=f"start: {{x: {sx}, y: {sy}, heading: {yaw}}}",
            via=f"via: {[list(p) for p in places]}",
        ),
    ).course
    wanted = np.array([turned(*p) for p in straight.centreline])
    line = shapely.LineString(again.centreline)
    assert max(line.distance(shapely.Point(p)) for p in wanted) < 0.01
    assert len(again.walls) == len(straight.walls)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"start": "start: {x: 90, y: 0, heading: 0}"}, "route.yaml:3: start: (90, 0) is not on "),
        ({"start": "start: {x: 0, y: 1.1, heading: 0}"}, "route.yaml:3: start: stands in a wall"),
        (
            {"via": "via: [[-1.2, -2.0], [-0.5, 0.0]]", "gates": ""},
            "via.0: (-1.2, -2) is in a wall",
        ),
        (
            {"start": "start: {x: 0, y: 0.85, heading: 0}"},
            "route.yaml:3: start: stands nearer to a wall than half the chair's width",
        ),
        ({"gates": "gates: [R1, R2]"}, "route.yaml:8: gates: 2 names; allowed: 3"),
        ({"gates": "gates: [R1, R1, F]"}, "route.yaml:8: gates: names must differ"),
        ({"gates": "gates: [R1, R2, null]"}, "route.yaml:8: gates: the last via needs a name"),
        ({"gates": "clearence_m: 1"}, "route.yaml:8: clearence_m: "),
        (
            {"via": "via: [[0.0, 0.02], [1.5, 0.0]]", "gates": ""},
            "route.yaml:4: via.0: (0, 0.02) is where the start is",
        ),
        (
            {"via": "via: [[1.5, 0.0], [0.2, 0.0]]", "gates": ""},
            "route.yaml:4: via: the route doubles back at",
        ),
    ],
)
def test_a_route_that_cannot_be_is_one_line(changes, message, bring_in):
    """File, line, field and what is allowed."""
    with pytest.raises(InputError, match=re.escape(message)):
        bring_in(**changes)


def _square(tmp_path, gap):
    """Draw two rooms with a passage between them."""
    grey = np.full((80, 160), 254, dtype=np.uint8)
    grey[:3], grey[-3:], grey[:, :3], grey[:, -3:] = 0, 0, 0, 0
    grey[:, 78:82] = 0
    grey[40 : 40 + gap, 78:82] = 254
    grey[20, 20] = 0
    Image.fromarray(grey).save(tmp_path / "map.png")
    (tmp_path / "map.yaml").write_text("image: map.png\nresolution: 0.05\norigin: [0, 0, 0]\n")
    return read_map(tmp_path / "map.yaml")


def test_a_via_nobody_reaches_is_named(tmp_path, route):
    """A passage narrower than the chair."""
    drawn = _square(tmp_path, gap=8)
    path = route(start="start: {x: 1, y: 2, heading: 0}", via="via: [[3, 2.0], [6, 2.0]]", gates="")
    with pytest.raises(InputError, match=r"via\.1: nothing as wide as the chair gets there from"):
        import_course(drawn, path)


def test_specks_are_dropped_and_counted(tmp_path, route):
    """A single dark cell in the middle of a room is no obstacle."""
    drawn = _square(tmp_path, gap=30)
    path = route(start="start: {x: 1, y: 1, heading: 0}", via="via: [[3, 1.2], [6, 1.2]]", gates="")
    done = import_course(drawn, path)
    assert done.specks == 1
    assert len(done.course.walls) == 1
    assert not done.course.furniture


def test_a_draft_starts_in_free_space(tmp_path):
    """It is a route file, and its start has room for the chair."""
    drawn = _square(tmp_path, gap=30)
    (tmp_path / "draft.yaml").write_text(draft_route(drawn))
    draft, _ = read_mapping(tmp_path / "draft.yaml", Route)
    assert 1 < draft.start.y < 3


def test_the_shipped_example_is_a_route(tmp_path):
    """It can be copied as it is."""
    (tmp_path / "r.yaml").write_text(shipped_text("map-route"))
    assert len(read_mapping(tmp_path / "r.yaml", Route)[0].via) == 4


def arc(turn, radius):
    """Return a path that turns by an angle (left positive) on a circle, with straights around."""
    n = max(2, round(abs(turn) * radius / 0.05))
    heading = np.concatenate([np.zeros(60), np.linspace(0, turn, n), np.full(60, turn)])
    steps = 0.05 * np.stack([np.cos(heading), np.sin(heading)], axis=1)
    return np.concatenate([[[0.0, 0.0]], np.cumsum(steps, axis=0)])


@pytest.mark.parametrize(
    ("degrees", "radius", "kind"),
    [(-135, 0.55, "sharp_right"), (-90, 0.8, "sharp_right"), (-45, 1.5, "soft_right"),
     (-90, 2.0, "soft_right"), (90, 0.6, "left")],
)  # fmt: skip
def test_bends_are_labelled_by_how_tight_they_are(degrees, radius, kind):
    """A circle's arc: its turn within 10%, and its kind."""
    (found,) = bends(arc(math.radians(degrees), radius), 0.05)
    assert found.kind == kind
    assert math.degrees(found.turn) == pytest.approx(degrees, rel=0.1)


def test_only_a_path_that_turns_on_the_spot_doubles_back():
    """Half a circle of 1 m radius is a bend; a hairpin of 10 cm is none."""
    assert doubling_back(arc(math.pi, 1.0), 0.05) is None
    assert doubling_back(arc(math.pi, 0.1), 0.05) is not None
