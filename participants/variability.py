"""What makes a human demonstrator's interventions unlike one another."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from lad.command import Command
from protocols.wheelchair import within_limits

TOUCH_S = 0.4
"""How long a takeover lasts where no help is needed, s: assumption."""


@dataclass(frozen=True, slots=True)
class Drawn:
    """What one intervention is like.

    Attributes
    ----------
    onset_m
        How much farther along the way the turn is seen to begin, m.
    release
        Share of the usual angle at which the chair is handed back; 0 or more.
    pace
        Added to the pace.
    """

    onset_m: float = 0.0
    release: float = 1.0
    pace: float = 0.0


USUAL = Drawn()


class Variability:
    """One lap's variability; fields of 0 make no draw.

    Parameters
    ----------
    fields
        ``onset_sd_m``, ``submovements_hz``, ``submovement_noise``, ``touches_per_lap``,
        ``release_sd`` and ``pace_sd`` as ``AttentiveOptions`` has them.
    lap_m
        Length of the way, over which touches are spread, m.
    rng
        Its own random numbers.
    """

    def __init__(self, fields: Mapping[str, float], lap_m: float, rng: np.random.Generator) -> None:
        self._fields, self._lap_m, self._rng = fields, lap_m, rng
        self._held: tuple[float, Command] | None = None
        self._arc: float | None = None
        self._touch_until = -math.inf

    def intervention(self) -> Drawn:
        """Draw what the next intervention is like."""
        sds = [self._fields[name] for name in ("onset_sd_m", "release_sd", "pace_sd")]
        if not any(sds):
            return USUAL
        onset, release, pace = (sd * float(z) for sd, z in zip(sds, self._normals(), strict=True))
        self._held = None
        return Drawn(onset, max(1.0 + release, 0.0), pace)

    def _normals(self) -> list[float]:
        return [float(z) for z in self._rng.normal(size=3)]

    def in_steps(self, t: float, command: Command) -> Command:
        """Return what a hand that corrects in steps does of a command at time t, s."""
        rate = self._fields["submovements_hz"]
        if not rate:
            return command
        if self._held is None or t >= self._held[0] + 1.0 / rate - 1e-9:
            v, w = 1.0 + self._fields["submovement_noise"] * self._rng.normal(size=2)
            off = Command(float(v) * command.v, float(w) * command.w)
            self._held = (t, within_limits(off))
        return self._held[1]

    def touches(self, t: float, arc: float) -> bool:
        """Say whether it touches the stick now although no help is needed.

        Parameters
        ----------
        t
            Time in the lap, s.
        arc
            Where the chair is on the way, m.
        """
        often = self._fields["touches_per_lap"]
        if not often:
            return False
        before, self._arc = self._arc, arc
        gone = 0.0 if before is None else max(arc - before, 0.0)
        if t >= self._touch_until and self._rng.random() < 1.0 - math.exp(
            -often * gone / self._lap_m
        ):
            self._touch_until = t + TOUCH_S
        return t < self._touch_until
