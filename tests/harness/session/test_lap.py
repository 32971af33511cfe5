"""A lap: the order of a step, who is heard, and how it ends."""

from dataclasses import replace

import numpy as np
import pytest

from harness.session.arbitration import takeover
from harness.session.clock import LapStoppedError, Timing, VirtualClock
from harness.session.lap import Lap, LapParts, Rules
from harness.session.limitation import right_turn_limit, unlimited
from harness.world.world import Observation
from lad.assistant import NO_ASSISTANCE, Assistance
from lad.command import STILL, Command
from lad.inputs import N_SEGMENTS
from participants.driver import WithdrewError
from protocols.course.gates import GateCounter
from protocols.load import load_course
from protocols.pose import Pose

PERIOD = 0.1


class StraightWorld:
    """A world without walls: the chair follows every command at once, and nothing drifts."""

    period = PERIOD
    bearings = np.linspace(-2, 2, 21)
    laser_offset = 0.5

    def __init__(self, diary, pose):
        self.diary, self.pose, self.velocity, self.t = diary, pose, STILL, 0.0

    def observe(self):
        return Observation(
            t=self.t,
            pose=self.pose,
            velocity=self.velocity,
            ranges=np.full(21, 4.0),
            segments=np.full(N_SEGMENTS, 4.0),
            clearance_m=1.0,
            contact=False,
        )

    def safeguard(self, command):
        self.diary.append("safeguard")
        return Command(min(command.v, 0.6), command.w)

    def step(self, command):
        self.diary.append("step")
        x, y, heading = self.pose
        heading += command.w * PERIOD
        dx, dy = command.v * PERIOD * np.cos(heading), command.v * PERIOD * np.sin(heading)
        self.pose, self.velocity = Pose(x + dx, y + dy, heading), command
        self.t = round(self.t + PERIOD, 9)


class Someone:
    """Driver, demonstrator and model in one: says what it was told to say, and keeps a diary."""

    def __init__(self, name, diary, says):
        self.name, self.diary, self.says, self.saw = name, diary, says, []

    def start_lap(self, *_):
        pass

    def act(self, sight):
        self.diary.append(self.name)
        self.saw.append(sight)
        return self.says(len(self.saw) - 1)

    def assist(self, x):
        self.diary.append(self.name)
        self.saw.append(x)
        return self.says(len(self.saw) - 1)


class Watcher(Someone):
    """A demonstrator: one who also sees the room."""

    def look(self, sight):
        self.diary.append("look")


class Pupil(Someone):
    """A model: one who also learns."""

    def learn(self, helping, command):
        self.diary.append(f"learn {helping}")


class Keeper:
    """Keeps the steps it is given."""

    def __init__(self, diary):
        self.diary, self.steps = diary, []

    def record(self, step):
        self.diary.append("record")
        self.steps.append(step)


HELP = Assistance(helping=True, command=Command(0.2, -0.5))


@pytest.fixture
def stage():
    """Build a lap: a driver who always turns right, a demonstrator who helps, a model who waits."""
    course = load_course("lab-office")
    start = Pose(course.start.x, course.start.y, course.start.heading)

    def build(assistant="none", training=False, driver=lambda _: Command(0.7, -0.5), **rules):
        diary = []
        parts = LapParts(
            Someone("driver", diary, driver),
            Watcher("demonstrator", diary, lambda _: HELP),
            Pupil("model", diary, lambda _: NO_ASSISTANCE),
        )
        settled = {
            "limitation": right_turn_limit(0.15),
            "arbitration": takeover,
            "safeguarded": True,
            "time_limit_s": 1.0,
        } | rules
        lap = Lap(
            StraightWorld(diary, start),
            parts,
            Rules(assistant=assistant, training=training, **settled),
            GateCounter(course),
        )
        return lap, parts, Keeper(diary), diary

    return build


def test_a_step_has_one_order(stage):
    """Drive, look, answer, guard, move, record, and only then learn."""
    lap, _, keeper, diary = stage("demonstrator", training=True)
    lap.drive(keeper, VirtualClock())
    order = ["driver", "look", "demonstrator", "model", "safeguard", "step", "record", "learn True"]
    assert diary == order * 10


def test_the_model_gets_nineteen_numbers_and_never_the_room(stage):
    """The model's inputs are the limited command, the velocities and the segments; no pose."""
    lap, parts, keeper, _ = stage()
    lap.drive(keeper, VirtualClock())
    x = parts.model.saw[0]
    assert x.shape == (19,)
    np.testing.assert_allclose(x[:4], [0.7, -0.15, 0, 0])
    assert (x[4:] == 4.0).all()


@pytest.mark.parametrize(
    ("assistant", "control", "moved"),
    [
        ("none", "driver", Command(0.6, -0.15)),
        ("demonstrator", "demonstrator", Command(0.2, -0.5)),
        ("model", "driver", Command(0.6, -0.15)),
    ],
)
def test_only_the_conditions_assistant_counts(stage, assistant, control, moved):
    """All parts answer in every lap; the condition decides whose answer moves the chair."""
    lap, _, keeper, _ = stage(assistant)
    lap.drive(keeper, VirtualClock())
    step = keeper.steps[3]
    assert (step.control, step.executed) == (control, moved)
    assert step.demonstrator is HELP
    assert step.intent == Command(0.7, -0.5)


def test_nothing_is_learnt_outside_training(stage):
    """A model watches laps that do not train it, and learns nothing."""
    lap, _, keeper, diary = stage("demonstrator")
    lap.drive(keeper, VirtualClock())
    assert not any(entry.startswith("learn") for entry in diary)


def test_the_safeguard_is_the_protocols_to_switch_off(stage):
    """Without the safeguard commands go to the chair as arbitrated."""
    lap, _, keeper, diary = stage(safeguarded=False)
    lap.drive(keeper, VirtualClock())
    assert "safeguard" not in diary
    assert keeper.steps[0].executed == keeper.steps[0].arbitrated


def test_a_driver_who_has_no_new_answer_holds_the_stick(stage):
    """None means: nothing new; the last command stands, and before the first one the chair."""
    lap, _, keeper, _ = stage(driver=lambda i: Command(0.3, 0.1) if i == 2 else None)
    lap.drive(keeper, VirtualClock())
    assert [s.intent for s in keeper.steps[:4]] == [STILL, STILL, *[Command(0.3, 0.1)] * 2]


def test_a_lap_that_takes_too_long_ends_unfinished(stage):
    """The time limit ends a lap with its reason."""
    lap, _, keeper, _ = stage(time_limit_s=0.5)
    ending = lap.drive(keeper, VirtualClock())
    assert (ending.reason, ending.t, len(keeper.steps)) == ("time_limit", 0.5, 5)


def test_a_participant_may_leave(stage):
    """A withdrawal ends the lap; what happened before is kept, and so are the words."""

    def leave(i):
        if i == 4:
            raise WithdrewError("I feel dizzy")
        return STILL

    lap, _, keeper, _ = stage(driver=leave)
    ending = lap.drive(keeper, VirtualClock())
    assert (ending.reason, ending.note, len(keeper.steps)) == ("withdrew", "I feel dizzy", 4)


def test_the_lap_ends_in_the_moment_of_crossing(stage):
    """Lap time is the moment the last gate is crossed, not the end of that control step."""
    lap, _, keeper, _ = stage(limitation=unlimited, time_limit_s=9.0)
    course = load_course("lab-office")
    finish = course.gates[-1]
    lap._gates._gates = (finish,)
    middle = np.mean([finish.left, finish.right], axis=0)
    across = np.subtract(finish.left, finish.right)
    ahead = np.array([across[1], -across[0]]) / np.hypot(*across)
    start = Pose(*(middle - 0.25 * ahead), float(np.arctan2(ahead[1], ahead[0])))
    lap._world.pose = start
    lap._seen = lap._world.observe()
    lap._parts.driver.says = lambda _: Command(0.5, 0.0)
    ending = lap.drive(keeper, VirtualClock())
    assert ending.reason == "finished"
    assert ending.t == pytest.approx(0.5, abs=1e-6)


def test_a_silent_driver_stops(stage):
    """Without a new command the last one stands for 0.3 s; then the chair is told to stand."""
    lap, _, keeper, _ = stage(driver=lambda n: Command(0.5, 0.1) if n in {0, 6} else None)
    lap.drive(keeper, VirtualClock())
    speeds = [step.intent.v for step in keeper.steps]
    assert speeds == [0.5, 0.5, 0.5, 0.5, 0.0, 0.0, 0.5, 0.5, 0.5, 0.5]
    ages = [round(step.input_age_s, 6) for step in keeper.steps]
    assert ages == [0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.0, 0.1, 0.2, 0.3]


def test_a_driver_who_never_says_anything_stands(stage):
    """There is no command to hold before the first one."""
    lap, _, keeper, _ = stage(driver=lambda _: None, hold_s=0.2)
    lap.drive(keeper, VirtualClock())
    assert {step.intent for step in keeper.steps} == {STILL}


class StopsAfter:
    """A clock that is stopped after some steps, and that returns how late each step was."""

    def __init__(self, steps):
        self.left = steps

    def start(self, t=0.0):
        return Timing(0.0, 0.0, 0.0)

    def wait_until(self, t):
        self.left -= 1
        if not self.left:
            raise LapStoppedError("stopped", "the chair is in the way")
        return Timing(0.001 * self.left, 0.0, 0.5 * (self.left == 2))


def test_who_holds_the_clock_can_stop_a_lap(stage):
    """A stop ends the lap between two steps; reason and note are kept, and each step's timing."""
    lap, _, keeper, _ = stage()
    ending = lap.drive(keeper, StopsAfter(4))
    assert (ending.reason, ending.note) == ("stopped", "the chair is in the way")
    assert [step.timing.late_s for step in keeper.steps] == [0.0, 0.003, 0.002, 0.001]
    assert ending.last is keeper.steps[-1].result


def test_what_people_give_is_noted_before_it_acts(stage):
    """The journal is told of a step's inputs before the world moves."""
    lap, _, keeper, diary = stage("demonstrator")

    class Notes:
        def tick(self, command, demonstrator, timing, telemetry):
            diary.append(("note", command, demonstrator, timing))

    lap._journal = Notes()
    lap.drive(keeper, VirtualClock())
    notes = [
        i for i, entry in enumerate(diary) if entry == ("note", Command(0.7, -0.5), HELP, None)
    ]
    assert len(notes) == len(keeper.steps) == 10
    assert all(diary[i + 1] == "step" for i in notes)


class Peeping(Pupil):
    """A model with a method by which it would see the room."""

    def look(self, sight):
        self.diary.append("the model looks")


def test_a_model_with_a_method_look_is_not_shown_the_room(stage):
    """Only the demonstrator is; and whoever the lap was explicitly given as an onlooker."""
    lap, parts, _, diary = stage()
    for onlookers, shown in (((), False), (None, True)):
        model = Peeping("model", diary, lambda _: NO_ASSISTANCE)
        there = (model,) if onlookers is None else onlookers
        again = Lap(
            lap._world, replace(parts, model=model, onlookers=there), lap._rules, lap._gates
        )
        again._step(None)
        assert ("the model looks" in diary) is shown
