"""The attentive demonstrator helps through sharp right turns, and nowhere else, on any course."""

import math

import numpy as np
import pytest

from lad.command import Command
from participants.attentive import EARLIEST, LATEST, AttentiveDemonstrator, AttentiveOptions
from participants.registry import make_demonstrator, make_driver
from participants.setup import DemonstratorSetup, DriverSetup
from participants.sight import Sight
from protocols.files.errors import InputError
from protocols.pose import Pose
from protocols.wheelchair import MAX_TURN_RATE


def demonstrator(course, seed=0, **options):
    """Return an attentive demonstrator with its own random numbers."""
    setup = DemonstratorSetup(course, np.random.default_rng(seed), options)
    return make_demonstrator("attentive", setup)


def autonomous(course):
    """Return an autonomous driver at the start of a lap."""
    rd = make_driver("autonomous", DriverSetup(course, np.random.default_rng(0)))
    rd.start_lap(0, np.random.default_rng(0))
    return rd


@pytest.fixture(scope="module")
def helped(room, limitation):
    """Drive a limited lap with help on the default course."""
    return room.lap(autonomous(room.course), demonstrator(room.course), limitation=limitation)


@pytest.fixture(scope="module", params=["room", "winding"])
def driven(request, limitation):
    """Drive helped and shadowed laps, limited and not, on two courses."""
    room = request.getfixturevalue(request.param)
    laps = [
        room.lap(autonomous(room.course), demonstrator(room.course), **rules)
        for rules in (
            {"limitation": limitation},
            {"limitation": limitation, "helping": False},
            {"helping": False},
        )
    ]
    return room, laps


def test_one_stretch_of_help_at_each_sharp_right_turn(driven):
    """No help in left turns, soft bends and straights; no on and off; as a shadow as well."""
    room, laps = driven
    corners = [s for s in room.line.sections if s.kind == "sharp_right"]
    for lap in laps:
        assert lap.finished
        assert len(lap.intervals()) == len(corners)
        arc, helping = lap.column("arc"), lap.column("h") > 0
        for corner in corners:
            assert helping[(arc >= corner.start) & (arc <= corner.end)].any()
        near = np.zeros(len(arc), dtype=bool)
        for corner in corners:
            near |= (arc >= corner.start - EARLIEST) & (arc <= corner.end + LATEST)
        assert not helping[~near].any()


def test_help_gives_back_most_of_what_the_limitation_costs(driven):
    """The helped lap is well below the limited one, and above the free one."""
    _, (with_help, limited, free) = driven
    assert with_help.contacts == 0
    assert free.time < with_help.time < limited.time
    if limited.time - free.time > 15.0:
        assert limited.time - with_help.time > 0.5 * (limited.time - free.time)


def test_takeover_begins_near_the_beginning_of_the_turn(helped):
    """Help comes within about a second of the driver's pushing the stick right."""
    t, stick = helped.column("t"), helped.column("user_w")
    for begin, _ in helped.intervals():
        before = (t > begin - 3.0) & (t <= begin) & (stick < -0.1)
        assert before.any()
        assert 0.1 <= begin - t[before][0] <= 1.6


def test_it_steers_right_at_full_rate_and_hands_back_aligned(helped, room):
    """Unlimited turns, and at the end the chair points along the next leg."""
    heading, helping = helped.column("heading"), helped.column("h") > 0
    assert helped.column("a_w")[helping].min() == -MAX_TURN_RATE
    ends = np.flatnonzero(np.diff(helping.astype(int)) == -1) + 1
    corners = [s for s in room.line.sections if s.kind == "sharp_right"]
    for end, corner in zip(ends, corners, strict=True):
        leg = room.line.point(corner.end + 1.0).heading
        assert abs(math.remainder(heading[end] - leg, math.tau)) < math.radians(20)


def test_the_style_is_the_same_every_time(room, limitation):
    """Commands at the same place of a corner differ little between laps."""
    who, places = demonstrator(room.course), np.linspace(2.2, 2.9, 8)
    commands = []
    for _ in range(2):
        lap = room.lap(autonomous(room.course), who, limitation=limitation)
        helping = (lap.column("h") > 0) & (lap.column("arc") < 4)
        arc = lap.column("arc")[helping]
        commands.append([np.interp(places, arc, lap.column(a)[helping]) for a in ("a_v", "a_w")])
    difference = np.abs(np.subtract(*commands))
    assert difference.max() < 0.1
    assert difference.any()


def watch(who, pose, t=0.0, *, stick=0.0, turning=0.0, helped=False):
    """Show the demonstrator a moment and return its answer."""
    ranges, bearings = np.full(61, 4.0), np.linspace(-2.0, 2.0, 61)
    who.look(Sight(t, pose, Command(0.2, turning), ranges, bearings, 0.6, 0, helped))
    x = np.zeros(19)
    x[1] = stick
    return who.assist(x)


CORNER = Pose(3.6, 0.0, 0.0)


@pytest.mark.parametrize("offset", [-0.5, -0.25, 0.0, 0.25, 0.5])
@pytest.mark.parametrize("heading", [-0.4, 0.0, 0.4])
def test_odd_entries_are_helped_too(winding, offset, heading):
    """Off the middle and askew, the turn is seen, and help ends once it is made."""
    who = demonstrator(winding.course, reaction_s=0.0)
    entry = Pose(3.6, offset, heading)
    assert watch(who, entry, 0.0).helping
    assert watch(who, Pose(3.9, offset / 2 - 0.3, -0.8), 1.0).helping
    assert not watch(who, Pose(4.0, -1.3, -math.pi / 2), 2.0).helping


def test_help_waits_for_the_turn_to_begin(winding):
    """Before the corner one helps only who has begun to turn, by stick or by chair."""
    before = Pose(3.0, 0.0, 0.0)
    who = demonstrator(winding.course, reaction_s=0.0)
    assert not watch(who, before).helping
    assert watch(who, before, 0.1, stick=-0.15).helping
    who.start_lap()
    assert watch(who, before, 0.0, turning=-0.2).helping
    who.start_lap()
    assert not watch(who, Pose(1.0, 0.0, 0.0), 0.0, stick=-0.15).helping


def test_reaction_takes_time_and_varies(winding):
    """From one intervention to the next the delay is drawn again, around its median."""
    who = AttentiveDemonstrator(winding.course, AttentiveOptions(), np.random.default_rng(3))
    delays = []
    for _ in range(60):
        who.start_lap()
        delays.append(next(t / 100 for t in range(300) if watch(who, CORNER, t / 100).helping))
    assert np.median(delays) == pytest.approx(0.4, abs=0.08)
    assert 0.05 < np.std(delays) < 0.2


def test_hysteresis(winding):
    """Nearly aligned, help that runs continues; help that has ended does not start again."""
    who = demonstrator(winding.course, reaction_s=0.0)
    nearly, aligned = Pose(4.0, -0.4, -1.2), Pose(4.0, -0.4, -math.pi / 2)
    assert watch(who, CORNER, 0.0).helping
    assert watch(who, nearly, 1.0).helping
    assert not watch(who, aligned, 2.0).helping
    assert not watch(who, nearly, 3.0).helping


def test_laps_are_its_random_numbers(room, limitation):
    """The same generator makes the same laps, and a lap differs from the one before."""
    laps = []
    for seed in (1, 1):
        who = demonstrator(room.course, seed)
        laps += [
            room.lap(autonomous(room.course), who, limitation=limitation).rows for _ in range(2)
        ]
    first, second, same_first, same_second = (np.array(rows) for rows in laps)
    assert np.array_equal(first, same_first, equal_nan=True)
    assert np.array_equal(second, same_second, equal_nan=True)
    assert not np.array_equal(first, second, equal_nan=True)


def test_a_shadow_does_not_depend_on_whether_it_is_obeyed(room):
    """Shown the same moments, a shadow and an obeyed demonstrator decide alike."""
    laps = [room.lap(autonomous(room.course), demonstrator(room.course), helping=False)]
    shadow, obeyed = demonstrator(room.course), demonstrator(room.course)
    for who in (shadow, obeyed):
        who.start_lap()
    for row in laps[0].rows:
        pose, helped = Pose(*row[1:4]), row[8] > 0
        a = watch(shadow, pose, row[0], stick=row[7], turning=row[5])
        b = watch(obeyed, pose, row[0], stick=row[7], turning=row[5], helped=helped)
        assert a.helping == b.helping


def test_options_are_checked(lab_office):
    """A delay below 0 is an error that names the option."""
    with pytest.raises(InputError, match="option 'reaction_s'"):
        demonstrator(lab_office, reaction_s=-1.0)


def test_it_abstains_once_it_has_seen_that_the_user_can_turn(room, limitation):
    """In the lap after one with whole turns it never helps; after slowed ones, as always."""
    watches = demonstrator(room.course, enough_rad_s=0.28)
    intervals = []
    for rules in ({}, {}, {"limitation": limitation}, {"limitation": limitation}):
        lap = room.lap(autonomous(room.course), watches, **rules)
        assert lap.finished
        intervals.append(len(lap.intervals()))
    assert intervals[1] == 0
    assert intervals[3] == 2
