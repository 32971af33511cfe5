"""What a session costs in CPU time, beside the same session of another checkout.

Both run in processes of their own and take turns, session by session, so that what else the machine
does falls on both alike. Each is a checkout of this repository with the same session classes:

    git worktree add ../before COMMIT
    python bench/session_cpu.py --against ../before

Take the ratio; the CPU seconds depend on the machine and on what shares its cores.
"""

import argparse
import json
import os
import statistics
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).resolve().parents[1]

SERVE = """
import gc, sys, time
from harness.session.parts import make_parts
from harness.session.session import Session
from harness.session.study_run import StudyRun
from harness.world.bullet_world import BulletWorld
from protocols.load import resolve_study
from protocols.record import session as record

run = StudyRun(resolve_study(sys.argv[1]), 0)
study = run.study
world = BulletWorld(study.course, study.protocol.laser, study.protocol.control_period_s)
for line in sys.stdin:
    gc.collect()
    number = int(line)
    begun = time.process_time()
    done = Session(run, number, world, make_parts(run, number)).run()
    record.encode(done)
    spent = time.process_time() - begun
    print(spent, sum(lap.row.steps for lap in done.laps), flush=True)
"""


@dataclass(frozen=True, slots=True)
class Cost:
    """CPU seconds of sessions of one checkout.

    Attributes
    ----------
    seconds
        One for each session, in the order run.
    steps
        Control steps of all of them.
    """

    seconds: tuple[float, ...]
    steps: int

    @property
    def per_session(self) -> float:
        """Median over the sessions, s."""
        return statistics.median(self.seconds)

    @property
    def per_step(self) -> float:
        """Mean over all control steps, s."""
        return sum(self.seconds) / self.steps


class Checkout:
    """A process that runs sessions with the code of one checkout.

    Parameters
    ----------
    tree
        The checkout.
    protocol
        A shipped protocol's name.
    """

    def __init__(self, tree: Path, protocol: str) -> None:
        self._process = subprocess.Popen(  # noqa: S603  # this very interpreter
            [sys.executable, "-c", SERVE, protocol],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            cwd=tree,  # python -c imports from there first
            env=os.environ | {"PYTHONPATH": str(tree), "OMP_NUM_THREADS": "1"},
        )

    def session(self, number: int) -> tuple[float, int]:
        """Run a participant's session; return its CPU seconds and its control steps."""
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        self._process.stdin.write(f"{number}\n")
        self._process.stdin.flush()
        seconds, steps = self._process.stdout.readline().split()
        return float(seconds), int(steps)

    def close(self) -> None:
        """End the process."""
        self._process.communicate("")


def measure(trees: Sequence[Path], protocol: str, sessions: int) -> list[Cost]:
    """Return what sessions cost in each checkout; they take turns.

    Parameters
    ----------
    trees
        The checkouts.
    protocol
        A shipped protocol's name.
    sessions
        How many participants; the first one runs once more before anything is timed.

    Raises
    ------
    AssertionError
        When the checkouts do not drive the same number of steps: they would not be comparable.
    """
    checkouts = [Checkout(tree, protocol) for tree in trees]
    for checkout in checkouts:
        checkout.session(1)
    rounds = [
        [checkout.session(number) for checkout in checkouts] for number in range(1, sessions + 1)
    ]
    for checkout in checkouts:
        checkout.close()
    costs = []
    for one in zip(*rounds, strict=True):
        seconds, steps = zip(*one, strict=True)
        costs.append(Cost(seconds, sum(steps)))
    assert len({cost.steps for cost in costs}) == 1, "the checkouts drive differently"
    return costs


def main() -> None:
    """Measure this checkout, and another one beside it if asked to."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument("--against", type=Path, help="another checkout")
    parser.add_argument("--protocol", default="four-lap")
    parser.add_argument("--sessions", type=int, default=15)
    parser.add_argument("--json", type=Path, help="write the figures there, too")
    given = parser.parse_args()
    trees = [HERE] if given.against is None else [HERE, given.against.resolve()]
    costs = measure(trees, given.protocol, given.sessions)
    found = {}
    for name, cost in zip(("here", "against"), costs, strict=False):
        found[name] = {"session_s": cost.per_session, "step_us": 1e6 * cost.per_step}
        print(f"{name}: {cost.per_session:.3f} s a session, {1e6 * cost.per_step:.0f} us a step")
    if len(costs) == 2:
        ratios = [a / b for a, b in zip(costs[0].seconds, costs[1].seconds, strict=True)]
        found["ratio"] = statistics.median(ratios)
        print(f"here / against: {found['ratio']:.3f} (median of {len(ratios)} pairs)")
    if given.json is not None:
        given.json.write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
