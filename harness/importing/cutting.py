"""One lap of a recording: cut out, its inputs computed as the simulated world computes them."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from harness.importing.mapping import BagMapping, CommandSource, Person, SignalSource
from harness.importing.recording import Stream
from harness.importing.signals import (
    between,
    command_sources,
    commands,
    largest_gap,
    latest,
    poses,
    segments,
    signals,
    velocity_of,
)
from harness.session.lap import Ending, Step
from harness.session.lap_log import LapLog, summary
from harness.session.latent_teaching import teach_inferred
from harness.session.limitation import limitation_of
from harness.session.model import basis_vectors, make_model
from harness.world.clearance import box_table, clearance
from harness.world.world import Observation
from lad.assistant import NO_ASSISTANCE, Assistance, Assistant, Learner
from lad.command import STILL, Command
from lad.inputs import as_inputs
from protocols.condition import Condition, LatentHelp
from protocols.course.centreline import Centreline
from protocols.course.gates import GateCounter
from protocols.course.obstacles import obstacle_boxes
from protocols.files.errors import InputError
from protocols.laps import PlannedLap
from protocols.pose import Pose
from protocols.record.rows import LapRow
from protocols.record.session import RecordedLap
from protocols.resolved import ResolvedStudy

START_AWAY_M = 2.0
"""A lap that begins farther from the course's start is named: frames may not fit."""


class _Nobody:
    """Stands where no model predicts."""

    def start_lap(self) -> None:
        """Forget nothing."""

    def assist(self, x: NDArray[np.float64]) -> Assistance:  # noqa: ARG002
        """Say nothing."""
        return NO_ASSISTANCE


@dataclass(frozen=True)
class _Sampled:
    """What was recorded, at the steps' times; one more pose and scan at the end."""

    poses: NDArray[np.float64]
    velocities: NDArray[np.float64]
    segments: NDArray[np.float64]
    intents: list[tuple[Command, float]]
    executed: NDArray[np.float64]
    limited: NDArray[np.float64] | None
    arbitrated: NDArray[np.float64] | None
    demonstrator: list[Assistance | None]
    assisted: NDArray[np.bool_] | None
    contact: NDArray[np.bool_] | None


@dataclass
class Cutting:
    """Cuts laps out of one recording."""

    path: Path
    mapping: BagMapping
    study: ResolvedStudy
    streams: dict[str, Stream]
    troubles: list[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        mapping, course = self.mapping, self.study.course
        stream = self.streams[mapping.pose.topic]
        placed = poses(stream, mapping.pose, self.path)
        self.ns, self._poses = self._numbers(stream, placed, "poses")
        self._commands = {
            (source.topic, source.stick): self._numbers(
                self.streams[source.topic],
                commands(self.streams[source.topic], source.stick, self.path),
                "commands",
            )
            for source in command_sources(mapping)
        }
        self._segments = segments(self.streams[mapping.scan.topic], mapping.scan, self.path)
        self._table = box_table(obstacle_boxes(course))
        self._centreline = Centreline(course)
        self._period = self.study.protocol.control_period_s
        recompute = mapping.model == "recompute"
        self.model: Assistant = make_model(self.study.protocol.model) if recompute else _Nobody()

    def _numbers(
        self, stream: Stream, values: NDArray[np.float64], what: str
    ) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
        """Return times and values of the messages that have them; name the others."""
        good = np.asarray(np.isfinite(values).all(axis=1))
        if not good.any():
            raise InputError(f"{self.path}: {stream.topic}: none of the {what} is a number")
        if not good.all():
            self.troubles.append(
                f"{self.path}: {stream.topic}: {int((~good).sum())} of {len(good)} {what} are no "
                "numbers; they are left out"
            )
        return stream.ns[good], values[good]

    def lap(
        self, number: int, planned: PlannedLap, person: Person, begin: int, end: int
    ) -> RecordedLap:
        """Return one lap: from its mark to the last gate, its time limit, or the next mark."""
        condition = self.study.protocol.conditions[planned.condition]
        period = round(self._period * 1e9)
        limit = round(planned.time_limit_s / self._period)
        count = min(limit, (min(end, int(self.ns[-1])) - begin) // period)
        where = f"{self.path}: {person.participant} lap {number}"
        if count < 1:
            raise InputError(f"{where}: the recording ends before the lap's first step")
        times = begin + period * np.arange(count + 1, dtype=np.int64)
        sampled = self._sampled(times, where)
        self._check_start(sampled.poses[0], where)
        log = LapLog(self._centreline, demonstrated=condition.assistant == "demonstrator")
        ending, used = self._drive(condition, sampled, log, limit)
        self._check_gaps(begin, int(times[used]), where)
        table = log.table()
        if condition.latent_h is not None and isinstance(self.model, Learner):
            # The recorded command has its own error: none is added.
            table = teach_inferred(self.model, table, LatentHelp(), np.random.default_rng(0))
        row = LapRow(
            participant=person.participant,
            lap=number,
            condition=planned.condition,
            practice=planned.practice,
            limited=condition.limitation is not None,
            assistant=condition.assistant,
            training=condition.training and isinstance(self.model, Learner),
            seed=0,
            **summary(table, ending, self._period),
            **basis_vectors(self.model),
        )
        return RecordedLap(row, table)

    def _sampled(self, times: NDArray[np.int64], where: str) -> _Sampled:
        mapping = self.mapping
        velocity = velocity_of(mapping)
        speed_ns, speeds = self._commands[velocity.topic, velocity.stick]
        scans = latest(self.streams[mapping.scan.topic].ns, times)
        seen = self._segments[np.maximum(scans, 0)]
        missing = np.isnan(seen)
        if missing.any():
            self.troubles.append(
                f"{where}: {int(missing.sum())} of {missing.size} laser segments have no valid "
                "reading; nothing seen was put in"
            )
            seen = np.where(missing, 4.0, seen)
        return _Sampled(
            poses=between(self.ns, self._poses, times),
            velocities=between(speed_ns, speeds, times),
            segments=seen,
            intents=self._intents(times),
            executed=self._held(mapping.executed, times),
            limited=self._held(mapping.limited, times) if mapping.limited else None,
            arbitrated=self._held(mapping.arbitrated, times) if mapping.arbitrated else None,
            demonstrator=self._demonstrator(times),
            assisted=self._signal(mapping.assisted, times),
            contact=self._signal(mapping.contact, times),
        )

    def _held(self, source: CommandSource, times: NDArray[np.int64]) -> NDArray[np.float64]:
        """Return the command in force at each time; standing before the first one."""
        ns, values = self._commands[source.topic, source.stick]
        index = latest(ns, times)
        return np.where(index[:, None] >= 0, values[np.maximum(index, 0)], 0.0)

    def _intents(self, times: NDArray[np.int64]) -> list[tuple[Command, float]]:
        """Return what the driver wanted and how old that is; an old command is standing."""
        source = self.mapping.intent
        ns, values = self._commands[source.topic, source.stick]
        index = latest(ns, times)
        found = []
        for i, at in zip(index.tolist(), times.tolist(), strict=True):
            age = max(0.0, (at - int(ns[i])) / 1e9) if i >= 0 else np.inf
            old = age > self.study.protocol.hold_s + 5e-7
            command = STILL if old else Command(float(values[i, 0]), float(values[i, 1]))
            found.append((command, age if i >= 0 else 0.0))
        return found

    def _signal(
        self, source: SignalSource | None, times: NDArray[np.int64]
    ) -> NDArray[np.bool_] | None:
        if source is None:
            return None
        stream = self.streams[source.topic]
        index = latest(stream.ns, times)
        on: NDArray[np.bool_] = signals(stream, source, self.path)[np.maximum(index, 0)]
        return on & (index >= 0)

    def _demonstrator(self, times: NDArray[np.int64]) -> list[Assistance | None]:
        source = self.mapping.demonstrator
        helping = self._signal(self.mapping.takeover, times)
        if source is None or helping is None:
            return [None] * len(times)
        values = self._held(source, times)
        return [
            Assistance(helping=True, command=Command(float(v), float(w))) if on else NO_ASSISTANCE
            for on, (v, w) in zip(helping.tolist(), values.tolist(), strict=True)
        ]

    def _drive(
        self, condition: Condition, sampled: _Sampled, log: LapLog, limit: int
    ) -> tuple[Ending, int]:
        """Go through a lap's steps as ``Lap`` does; return its end and how many steps it took."""
        gates = GateCounter(self.study.course)
        self._limitation = limitation_of(condition.limitation, self._period)
        self.model.start_lap()
        observations = self._observations(sampled)
        before = next(observations)
        for i, after in enumerate(observations):
            step = self._step(condition, sampled, i, before, after)
            log.record(step)
            shown = step.demonstrator
            if shown is not None and isinstance(self.model, Learner) and _taught(condition, shown):
                self.model.learn(shown.helping, shown.command)
            crossed = gates.advance(before.pose, after.pose)
            if crossed is not None and gates.finished:
                t = before.t + crossed * self._period
                return Ending("finished", t, gates.passed, None, after), i + 1
            before = after
        steps = len(sampled.poses) - 1
        if steps >= limit:
            return Ending("time_limit", before.t, gates.passed, None, before), steps
        note = "the recording ends, or the next lap begins"
        return Ending("stopped", before.t, gates.passed, note, before), steps

    def _observations(self, sampled: _Sampled) -> Iterator[Observation]:
        for i, (x, y, heading) in enumerate(sampled.poses.tolist()):
            pose = Pose(x, y, float(np.arctan2(np.sin(heading), np.cos(heading))))
            room = clearance(self._table, pose)
            touched = room <= 0 if sampled.contact is None else bool(sampled.contact[max(i - 1, 0)])
            v, w = sampled.velocities[i].tolist()
            yield Observation(
                t=round(i * self._period, 9),
                pose=pose,
                velocity=Command(v, w),
                ranges=sampled.segments[i],
                segments=sampled.segments[i],
                clearance_m=max(0.0, room),
                contact=touched,
            )

    def _step(
        self,
        condition: Condition,
        sampled: _Sampled,
        i: int,
        before: Observation,
        after: Observation,
    ) -> Step:
        intent, age = sampled.intents[i]
        user = self._limitation(intent) if sampled.limited is None else _command(sampled.limited[i])
        x = as_inputs(user, before.velocity, before.segments)
        answer = self.model.assist(x)
        shown = sampled.demonstrator[i]
        by_role = {"none": NO_ASSISTANCE, "demonstrator": shown, "model": answer}
        assistance = by_role[condition.assistant] or NO_ASSISTANCE
        helped = assistance.helping if sampled.assisted is None else bool(sampled.assisted[i])
        executed = _command(sampled.executed[i])
        arbitrated = executed if sampled.arbitrated is None else _command(sampled.arbitrated[i])
        control = condition.assistant if helped and condition.assistant != "none" else "driver"
        return Step(
            before, x, intent, shown, answer, control, arbitrated, executed, after, age, None, {}
        )

    def _check_start(self, pose: NDArray[np.float64], where: str) -> None:
        start = self.study.course.start
        away = float(np.hypot(pose[0] - start.x, pose[1] - start.y))
        if away > START_AWAY_M:
            self.troubles.append(
                f"{where}: begins {away:.1f} m from the course's start; do frame and transform fit?"
            )

    def _check_gaps(self, begin: int, end: int, where: str) -> None:
        mapping = self.mapping
        intent, executed = mapping.intent, mapping.executed
        for topic, ns in (
            (mapping.pose.topic, self.ns),
            (mapping.scan.topic, self.streams[mapping.scan.topic].ns),
            (intent.topic, self._commands[intent.topic, intent.stick][0]),
            (executed.topic, self._commands[executed.topic, executed.stick][0]),
        ):
            gap, at = largest_gap(ns, begin, end)
            if gap > mapping.largest_gap_s:
                self.troubles.append(
                    f"{where}: no message of {topic} for {gap:.2f} s from {at:.1f} s on"
                )


def _command(row: NDArray[np.float64]) -> Command:
    return Command(float(row[0]), float(row[1]))


def _taught(condition: Condition, shown: Assistance) -> bool:
    """Say whether a step is learnt as it comes: of a lap of corrections, where help was given."""
    if not condition.training or condition.latent_h is not None:
        return False
    return condition.corrections is None or shown.helping
