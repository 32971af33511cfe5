"""Fluency of collaboration, after Hoffman (2019), IEEE Trans. Human-Machine Systems 49(3).

The human acts while the stick is deflected, the robot acts while an assistant's command counts.
"""

from collections.abc import Iterator, Sequence

import numpy as np

from analysis.measures.episodes import Episode, episodes
from analysis.measures.streams import (
    Flags,
    Steps,
    command,
    helped,
    once_per_lap,
    period,
    stretches_of_help,
)

DEAD_BAND = 0.05
"""Share of full deflection below which the stick counts as at rest."""


def human_idle(steps: Steps) -> float:
    """Return the share of the lap in which the user asked for nothing, 0 to 1."""
    active = _human(steps)
    return float("nan") if active is None else float((~active).mean())


def robot_idle(steps: Steps) -> float:
    """Return the share of the lap in which no assistance was given, 0 to 1."""
    active = helped(steps)
    return float("nan") if active is None else float((~active).mean())


def concurrent_activity(steps: Steps) -> float:
    """Return the share of the lap in which both user and assistant acted, 0 to 1."""
    human, robot = _human(steps), helped(steps)
    if human is None or robot is None:
        return float("nan")
    return float((human & robot).mean())


def functional_delay(steps: Steps) -> float:
    """Return the delay between the two agents' successive actions, as a share of the lap.

    Summed over hand-overs: the time from the end of one agent's action to the beginning of the
    other's next; where they overlap, the overlap counts as negative delay.

    Returns
    -------
    float
        Below 0 when they act at once; NaN without a hand-over, or where time does not increase
        from step to step: then it is unknown who acted first.
    """
    human, robot = _human(steps), stretches_of_help(steps)
    if human is None or robot is None or np.isnan(period(steps)):
        return float("nan")
    actions = sorted([(e, "human") for e in episodes(human)] + [(e, "robot") for e in robot])
    delays = list(_delays(actions))
    return sum(delays) / len(human) if delays else float("nan")


def _delays(actions: Sequence[tuple[Episode, str]]) -> Iterator[int]:
    """Yield the steps from the other agent's last action to each action that is a hand-over."""
    last: dict[str, Episode] = {}
    before = ""
    for episode, who in actions:
        other = last.get("robot" if who == "human" else "human")
        if other is not None:
            overlap = min(other.stop, episode.stop) - episode.start
            if overlap > 0 or before != who:
                yield -overlap
        last[who], before = episode, who


@once_per_lap
def _human(steps: Steps) -> Flags | None:
    size = np.linalg.norm(command(steps, "intent"), axis=1)
    if len(size) == 0 or np.isnan(size).any():
        return None
    return np.asarray(size > DEAD_BAND)
