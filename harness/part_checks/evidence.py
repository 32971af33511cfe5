"""Everything a part of a lap is asked once, and what each check then looks at."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from harness.part_checks.closed_loop import PLANS, Driven, bullet_world, drive, reference_laps
from harness.part_checks.play import Played, play
from harness.part_checks.role import Role
from harness.part_checks.setting import Setting
from harness.part_checks.shown import Laps
from harness.part_checks.source import PartSource
from harness.session.model import saved


@dataclass(frozen=True, slots=True)
class Evidence:
    """What parts made alike did.

    Attributes
    ----------
    recorded
        What ``first`` and ``again`` were shown: laps that others drove.
    first, again
        Two parts made alike, shown the same.
    driven
        Laps in which a third one took its place.
    repeated
        What a fourth one answers when it is shown what the third one was shown, while the world
        is at the start.
    saved
        The bytes of ``first`` after that, if it is saved and ``again`` is saved as the same.
    """

    recorded: Laps
    first: Played
    again: Played
    driven: Driven
    repeated: Played
    saved: bytes | None

    @property
    def every_answer(self) -> Mapping[str, Sequence[Any]]:
        """All answers by the lap's name: in driven laps, then to recorded ones."""
        driven = {f"lap {n}": lap for n, lap in enumerate(self.driven.answers, 1)}
        recorded = {f"recorded lap {n}": lap for n, lap in enumerate(self.first.answers, 1)}
        return driven | recorded


def gather(role: Role, source: PartSource, setting: Setting) -> Evidence:
    """Make the part four times, and ask each what a study would.

    Raises
    ------
    InputError
        When the part cannot be made with these options.
    """
    recorded: Laps = reference_laps(setting)
    one, other = source.make(role, setting), source.make(role, setting)
    first = play(role, one, recorded, setting.seed)
    if len(first.answers) < len(recorded) or len(first.answers[-1]) < len(recorded[-1]):
        recorded = first.as_far_as_answered(recorded)
    again = play(role, other, recorded, setting.seed)
    data = saved_if_possible(one)
    kept = data if data == saved_if_possible(other) else None
    with bullet_world(setting) as world:
        part, plans = source.make(role, setting), PLANS[role.name]
        driven = drive(role, part, world, setting, plans, lap_s=_affordable(recorded, setting))
        repeated = play(role, source.make(role, setting), driven.moments, setting.seed)
    return Evidence(recorded, first, again, driven, repeated, kept)


def _affordable(recorded: Laps, setting: Setting) -> float:
    """Return how long driven laps may be, s: no longer than a slow part can be shown."""
    steps = max((len(lap) for lap in recorded), default=0)
    return min(setting.lap_s, max(20, steps) * setting.period)


def saved_if_possible(part: Any) -> bytes | None:
    """Return the part's bytes; None where it has none, or cannot give them."""
    try:
        return saved(part)
    except (Exception, SystemExit):  # noqa: BLE001  # the check of saving reports what is wrong
        return None
