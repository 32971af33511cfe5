"""Other people's parts: one of each role that is right, and many with one thing wrong each."""

import math
import os
import sys
import time

import numpy as np

from harness.world.chair import VelocityController
from harness.world.world import Observation
from lad.assistant import NO_ASSISTANCE, Assistance
from lad.command import STILL, Command
from participants.driver import kind_of
from protocols.pose import Pose

TIMES = []

HELP = Assistance(helping=True, command=Command(0.2, -0.3))


def world_of_the_callers():
    """Find the lap's world by the frames of the callers."""
    frame = sys._getframe(1)
    while frame is not None:
        world = getattr(frame.f_locals.get("self"), "_world", None)
        if world is not None:
            return world
        frame = frame.f_back
    return None


class Ahead:
    """A driver who goes ahead, slower near obstacles, with a little noise of its own lap."""

    def __init__(self, setup):
        self.options = setup.options
        self.steps = 0

    def start_lap(self, lap, rng):
        self.lap, self.rng, self.steps = lap, rng, 0

    def act(self, sight):
        self.steps += 1
        near = float(np.min(sight.ranges))
        return Command(min(0.3, 0.2 * near), 0.01 * float(self.rng.uniform(-1, 1)))


class WithoutAct:
    """Lacks a method."""

    def __init__(self, setup):
        pass

    def start_lap(self, lap, rng):
        pass


class WantsMore(Ahead):
    """Wants to be told the pose."""

    def act(self, sight, pose):
        return STILL


class Robot(Ahead):
    """Says that it is what no participant is."""

    kind = "robot"


class Raising(Ahead):
    """Raises at once."""

    def act(self, sight):
        return [][self.steps]


class RaisingLater(Ahead):
    """Raises in its second lap."""

    def act(self, sight):
        if self.lap == 1:
            raise RuntimeError("not again")
        return super().act(sight)


class Hurried(Ahead):
    """Drives faster than any stick allows."""

    def act(self, sight):
        return Command(3.0, 0.0)


class Bare(Ahead):
    """Answers a tuple."""

    def act(self, sight):
        return tuple(super().act(sight))


class Lost(Ahead):
    """Does not answer a number."""

    def act(self, sight):
        return Command(math.nan, 0.0)


class NotReset(Ahead):
    """Stands for good once it has driven 40 steps."""

    total = 0

    def act(self, sight):
        self.total += 1
        return super().act(sight) if self.total <= 40 else STILL


class Unseeded(Ahead):
    """Draws from numbers of its own."""

    def act(self, sight):
        return Command(0.3, 0.1 * np.random.default_rng().random())


class Shared(Ahead):
    """Keeps in its module what belongs to one driver."""

    def act(self, sight):
        TIMES.append(sight.t)
        return Command(0.2 + 1e-6 * len(TIMES), 0.0)


class Digging(Ahead):
    """Asks the world itself where the chair is."""

    def act(self, sight):
        world = world_of_the_callers()
        return Command(0.3 if world is None else 0.25 + 1e-3 * world.observe().clearance_m, 0.0)


class DiggingOnly(Ahead):
    """The same, and fails where there is no world."""

    def act(self, sight):
        return Command(0.25 + 1e-3 * world_of_the_callers().observe().clearance_m, 0.0)


class Scribbling(Ahead):
    """Clips the laser's readings in place."""

    def act(self, sight):
        sight.ranges[sight.ranges > 2.0] = 2.0
        return super().act(sight)


class Taking(Ahead):
    """Takes its option out of what belongs to the protocol."""

    def __init__(self, setup):
        super().__init__(setup)
        self.share = setup.options.pop("share", 1.0)


class OfItsProcess(Ahead):
    """Drives as its process is numbered."""

    def act(self, sight):
        return Command(0.1 + os.getpid() * 1e-8, 0.0)


class Slow(Ahead):
    """Thinks for more than half a control period."""

    def act(self, sight):
        time.sleep(0.055)
        return super().act(sight)


class Remembering:
    """An assistant that repeats what was shown when the way ahead was most alike."""

    def __init__(self, reach=1.0):
        self.reach, self.seen, self.done, self.now = reach, [], [], None

    def start_lap(self):
        self.now = None

    def assist(self, x):
        self.now = x.copy()
        if not self.seen:
            return NO_ASSISTANCE
        nearest = int(np.linalg.norm(np.array(self.seen) - x, axis=1).argmin())
        command = self.done[nearest]
        return NO_ASSISTANCE if command is None else Assistance(helping=True, command=command)

    def learn(self, helping, command):
        self.seen.append(self.now)
        self.done.append(command if helping else None)

    def to_bytes(self):
        return repr([[*x.tolist(), d] for x, d in zip(self.seen, self.done, strict=True)]).encode()


class Looking(Remembering):
    """Would be shown the room."""

    def look(self, sight):
        self.sight = sight


class DiggingAssistant(Remembering):
    """Asks the world for the time."""

    def assist(self, x):
        world = world_of_the_callers()
        answer = super().assist(x)
        return answer if world is None else answer._replace(p_help=world.observe().t / 100)


class Carrying(Remembering):
    """Counts the steps of all laps."""

    count = 0

    def assist(self, x):
        self.count += 1
        return super().assist(x)._replace(p_help=1 / (1 + self.count))


class Commandless(Remembering):
    """Helps without a command."""

    def assist(self, x):
        return super().assist(x)._replace(helping=True, command=None)


class NumpyTruth(Remembering):
    """Answers with numpy's truth."""

    def assist(self, x):
        return super().assist(x)._replace(helping=np.bool_(False))


class Overwriting(Remembering):
    """Writes into its inputs."""

    def assist(self, x):
        answer = super().assist(x)
        x[4:] = 0.0
        return answer


class Dated(Remembering):
    """Is saved with the time."""

    def to_bytes(self):
        return repr(time.perf_counter_ns()).encode()


class BadlyLoaded(Remembering):
    """Comes back as another model."""

    @classmethod
    def from_bytes(cls, data):
        loaded = cls()
        loaded.seen, loaded.done = [np.zeros(19)], [Command(0.1, 0.1)]
        return loaded


class Helping:
    """A demonstrator that helps from 1 s on, until the lap ends."""

    def __init__(self, setup):
        self.t = 0.0

    def start_lap(self):
        self.t = 0.0

    def look(self, sight):
        self.t = sight.t

    def assist(self, x):
        return HELP if self.t > 1.0 else NO_ASSISTANCE


class Clinging(Helping):
    """Goes on helping in the next lap."""

    helped = False

    def assist(self, x):
        self.helped = self.helped or self.t > 1.0
        return HELP if self.helped else NO_ASSISTANCE


class Half:
    """An impairment that halves what is meant at severity 1."""

    def __init__(self, setup):
        self.driver, self.severity = setup.driver, setup.severity
        self.kind = kind_of(setup.driver)

    def start_lap(self, lap, rng):
        self.driver.start_lap(lap, rng)

    def act(self, sight):
        meant = self.driver.act(sight)
        return None if meant is None else self.changed(meant)

    def changed(self, meant):
        share = 1 - self.severity / 2
        return Command(share * meant.v, share * meant.w)


class AsksTwice(Half):
    """Asks its driver twice."""

    def act(self, sight):
        self.driver.act(sight)
        return super().act(sight)


class Drawing(Half):
    """Draws from its driver's numbers."""

    def start_lap(self, lap, rng):
        rng.random()
        super().start_lap(lap, rng)


class Kindless(Half):
    """Does not say what its driver is."""

    def __init__(self, setup):
        super().__init__(setup)
        del self.kind


class NobodyLeaves(Half):
    """Does not let its driver leave."""

    def act(self, sight):
        try:
            return super().act(sight)
        except Exception:  # noqa: BLE001  # that is what is wrong with it
            return STILL


class NeedsCommands(Half):
    """Cannot do without a new command."""

    def act(self, sight):
        return self.changed(self.driver.act(sight))


class AlwaysThere(Half):
    """Is there at severity 0, too."""

    def changed(self, meant):
        return Command(0.5 * meant.v, 0.5 * meant.w)


class Agreeing:
    """A respondent who agrees, more or less."""

    def __init__(self, setup):
        pass

    def answer(self, questions, experience, rng):
        return tuple(int(rng.integers(3, 6)) for _ in questions)


class Brief(Agreeing):
    """Leaves an answer out without a word."""

    def answer(self, questions, experience, rng):
        return super().answer(questions[1:], experience, rng)


class Between(Agreeing):
    """Answers between two points."""

    def answer(self, questions, experience, rng):
        return tuple(3.5 for _ in questions)


class Moody(Agreeing):
    """Answers as it likes."""

    def answer(self, questions, experience, rng):
        return tuple(int(np.random.default_rng().integers(1, 6)) for _ in questions)


class Confused(Agreeing):
    """Divides by the number of interventions."""

    def answer(self, questions, experience, rng):
        return 5 / experience.interventions


class OpenFloor:
    """A world without walls, with a laser that is a little noisy."""

    laser_offset = 0.5

    def __init__(self, course, period=0.1):
        self.period, self._start = period, course.start
        self.bearings = np.linspace(-2, 2, 21)
        self._controller = VelocityController()

    def reset(self, rng):
        self._rng, self._t, self._velocity = rng, 0, STILL
        self._pose = Pose(self._start.x, self._start.y, self._start.heading)
        self._controller.reset()
        self._look()

    def _look(self):
        ranges = 3.5 + 0.01 * self._rng.uniform(size=21)
        self._seen = Observation(
            self._t * self.period, self._pose, self._velocity, ranges, np.full(15, 3.5), 3.0, False
        )

    def observe(self):
        return self._seen

    def safeguard(self, command):
        return command

    def turned(self, w):
        return w * self.period

    def step(self, command):
        self._controller.approach(command, self.period)
        v, w = self._velocity = self._controller.velocity
        x, y, heading = self._pose
        d, heading = v * self.period, heading + self.turned(w)
        self._pose = Pose(x + d * math.cos(heading), y + d * math.sin(heading), heading)
        self._t += 1
        self._look()


class Mirrored(OpenFloor):
    """Turns the other way."""

    def turned(self, w):
        return -w * self.period


class Elsewhere(OpenFloor):
    """Starts somewhere else."""

    def reset(self, rng):
        super().reset(rng)
        self._pose = Pose(0.5, 0.0, 0.0)
        self._look()


class NoisyLook(OpenFloor):
    """Measures again when it is asked."""

    def observe(self):
        self._look()
        return self._seen


class Reused(OpenFloor):
    """Uses one array for every scan."""

    def _look(self):
        super()._look()
        if not hasattr(self, "_kept"):
            self._kept = np.empty(21)
        self._kept[:] = self._seen.ranges
        self._seen = self._seen._replace(ranges=self._kept)


class Pushing(OpenFloor):
    """Drives faster when guarded."""

    def safeguard(self, command):
        return Command(2 * command.v, command.w)


class Drifting(OpenFloor):
    """Its laser's offset grows with every lap."""

    laps = 0

    def reset(self, rng):
        self.laps += 1
        super().reset(rng)

    def _look(self):
        super()._look()
        self._seen = self._seen._replace(clearance_m=1.0 + self.laps)


class Endless(OpenFloor):
    """Says that nothing returned in its own way."""

    def _look(self):
        super()._look()
        self._seen = self._seen._replace(segments=np.full(15, np.inf))
