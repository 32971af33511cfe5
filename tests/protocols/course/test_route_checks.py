"""What nobody could drive is refused with its place; what the plan can avoid, it avoids."""

import math
import time
import tracemalloc

import numpy as np
import pytest

from protocols.course.drivable import undrivable
from protocols.course.route import plan_route
from protocols.course.schema import Course
from protocols.load import load_course, shipped_courses
from protocols.wheelchair import WIDTH


def _hall(gates, centreline, furniture=(), size=(12, 10)):
    """Return a hall with free-standing gates, each (name, left, right)."""
    width, height = size
    corners = [(0, 0), (width, 0), (width, height), (0, height)]
    start = centreline[0]
    heading = math.atan2(centreline[1][1] - start[1], centreline[1][0] - start[0])
    return Course.model_validate(
        {
            "name": "hall",
            "title": "Hall",
            "walls": [{"name": "hall", "closed": True, "points": corners}],
            "furniture": [
                {"name": f"f{i}", "x": x, "y": y, "length": length, "width": w}
                for i, (x, y, length, w) in enumerate(furniture)
            ],
            "start": {"x": start[0], "y": start[1], "heading": heading},
            "gates": [{"name": n, "left": left, "right": right} for n, left, right in gates],
            "centreline": centreline,
            "sections": [{"name": "all", "kind": "straight"}],
        }
    )


def _door(width, depth=0.1):
    """Return a hall with a doorway at x = 5."""
    side = 5 - width / 2
    furniture = [(5, side / 2, depth, side), (5, 10 - side / 2, depth, side)]
    return _hall([("F", (8, 6), (8, 4))], [(2, 5), (8, 5)], furniture)


@pytest.mark.parametrize("depth", [0.1, 0.5, 2.0])
@pytest.mark.parametrize("width", [0.5, 0.62, 0.7, 0.75, 0.8, 0.9, 1.2])
def test_an_opening_is_a_way_where_drivers_were_measured_to_pass(width, depth):
    """They pass 0.80 m and not 0.75 m; the width and the place are said."""
    fault = undrivable(_door(width, depth))
    assert (fault is None) == (width >= 0.8)
    if fault is not None:
        assert fault.where == ("gates", 0)
        if width > 0.62:
            assert f"{width:.2f} m wide at (" in fault.message


def test_a_bend_in_which_the_chair_cannot_turn_is_refused():
    """Each leg is wide enough for the chair, and the corner between them is not."""
    blocks = [(2.6, 5.0, 5.2, 9.0), (7.0, 4.55, 2.0, 8.1)]
    blocks = [(x, y - 0.05, length, w - 0.1) for x, y, length, w in blocks]
    course = _hall([("F", (9, 9.9), (9, 9.0))], [(5.6, 1.0), (5.6, 9.45), (9, 9.45)], blocks)
    assert undrivable(course) is None
    narrow = _hall(
        [("F", (9, 9.9), (9, 9.02))],
        [(5.6, 1.0), (5.6, 9.48), (9, 9.48)],
        [(2.6, 4.95, 5.2, 8.9), (7.0, 4.5, 2.0, 9.0), (5.6, 9.85, 1.2, 0.3), (7.5, 9.85, 2.6, 0.3)],
    )
    fault = undrivable(narrow)
    assert fault is not None
    assert fault.where == ("gates", 0)


@pytest.mark.parametrize("diameter", [1.5, 2.0, 3.0])
def test_a_turn_round_nothing_is_a_curve_and_passes_between_the_posts(diameter):
    """The shortest way would clip the near post and turn on the spot; the plan does not."""
    y = 6 - diameter
    middle = 6 - diameter / 2
    arc = [
        (7 + diameter / 2 * math.sin(a), middle + diameter / 2 * math.cos(a))
        for a in np.linspace(0.1, math.pi - 0.1, 12)
    ]
    gates = [
        ("U", (7 + diameter / 2 + 0.8, middle), (7 + diameter / 2 - 0.8, middle)),
        ("F", (3, y - 0.8), (3, y + 0.8)),
    ]
    course = _hall(gates, [(3, 6), *arc, (3, y)])
    assert undrivable(course) is None
    route = plan_route(course)
    x, _, _ = route.point(route.gate_arcs[0])
    assert abs(x - (7 + diameter / 2)) < 0.8 - 0.2
    ahead = np.searchsorted(route.arcs, route.arcs + 0.6).clip(max=len(route.arcs) - 1)
    assert np.abs(route.headings[ahead] - route.headings).max() < math.radians(115)


def test_a_dead_end_without_room_to_turn_is_refused():
    """The gate lies in a pocket that one can enter and not leave forwards."""
    blocks = [(5.05, 7.2, 3.9, 3.6), (5.05, 2.75, 3.9, 3.5), (8.5, 5, 0.3, 9.8)]
    gates = [("in", (6.2, 5.4), (6.2, 4.5)), ("out", (2.0, 4.0), (2.0, 6.0))]
    course = _hall(gates, [(1.5, 5), (6.4, 5), (6.9, 5.6), (6.9, 4.6), (2, 5)], blocks)
    fault = undrivable(course)
    assert fault is not None
    assert "gates" in fault.where or "centreline" in fault.where


def test_a_figure_whose_shortest_way_takes_a_later_gate_first_is_refused():
    """The centreline goes round; the shortest way to the second gate crosses the third."""
    gates = [
        ("A", (3, 6), (3, 4)),
        ("B", (8, 4), (8, 6)),
        ("C", (5.5, 7.6), (5.5, 2.6)),
    ]
    line = [(1.5, 5), (3.3, 5), (4, 8), (9.5, 8), (9.5, 5), (7.5, 5), (6.5, 2), (4.5, 2), (4.5, 5)]
    fault = undrivable(_hall(gates, [*line, (5.5, 5)]))
    assert fault is not None
    assert fault.where == ("gates", 1)
    assert "leads through gate C, which comes later" in fault.message


def test_two_swapped_points_of_the_centreline_are_found(ring):
    """It would go forth, back and forth again."""
    dense = [[x / 4, 0] for x in range(4, 18)]
    ring["centreline"] = [*dense, *ring["centreline"][2:]]
    assert undrivable(Course.model_validate(ring)) is None
    line = ring["centreline"]
    line[5], line[6] = line[6], line[5]
    fault = undrivable(Course.model_validate(ring))
    assert fault is not None
    assert fault.where == ("centreline", 5)
    assert "two points swapped" in fault.message


@pytest.mark.parametrize("far", [60, 120, 999])
def test_what_stands_far_away_costs_nothing(far):
    """One stray chair: the plan and the memory are the room's."""
    near = _hall([("F", (8, 6), (8, 4))], [(2, 5), (8, 5)])
    stray = _hall([("F", (8, 6), (8, 4))], [(2, 5), (8, 5)], [(far, far, 0.5, 0.5)])
    plan_route(near)
    tracemalloc.start()
    assert undrivable(stray) is None
    assert tracemalloc.get_traced_memory()[1] < 100e6
    tracemalloc.stop()
    assert plan_route(stray).length == pytest.approx(plan_route(near).length, abs=0.2)


def test_a_course_that_no_memory_holds_is_refused():
    """Gates a kilometre apart."""
    fault = undrivable(
        _hall([("F", (950, 951), (950, 949))], [(2, 5), (950, 950)], size=(999, 999))
    )
    assert fault is not None
    assert "square metres" in fault.message


def test_a_large_hall_with_many_pieces_is_planned_in_seconds():
    """Sixty by forty metres, three hundred pieces of furniture; counted is work, not waiting."""
    rng = np.random.default_rng(0)
    places = [(x, y) for x, y in rng.uniform((1, 8), (59, 39), (300, 2))]
    pieces = [(x, y, *rng.uniform(0.3, 0.9, 2)) for x, y in places]
    line = [(3, 4), (57, 4)]
    gates = [(f"G{x}", (x, 6), (x, 2)) for x in (15, 30, 45, 57)]
    course = _hall(gates, line, pieces, size=(60, 40))
    plan_route(_hall([("F", (8, 6), (8, 4))], [(2, 5), (8, 5)]))  # compiled by now
    begun = time.process_time()
    assert undrivable(course) is None
    assert time.process_time() - begun < 10


@pytest.mark.parametrize("name", shipped_courses())
def test_shipped_courses_have_room(name):
    """Half a chair's width and more on either side of every route."""
    course = load_course(name)
    route = plan_route(course)
    for gate, arc in zip(course.gates, route.gate_arcs, strict=True):
        x, y, _ = route.point(arc)
        assert min(math.dist((x, y), post) for post in (gate.left, gate.right)) > WIDTH
