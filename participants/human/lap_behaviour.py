"""One lap of one person: how the person moves the stick in each step."""

import math
from collections.abc import Mapping

import numpy as np

from lad.command import STILL, Command
from participants.human.caution import slowed
from participants.human.corners import Corner
from participants.human.hesitation import Hesitation
from participants.human.perception import DelayedView
from participants.human.practice import Skill
from participants.human.room import KnownRoom
from participants.human.steering import Situation, aim, aiming_distance, intend
from participants.human.stick import Stick
from participants.human.turn_response import TurnResponse
from participants.planning.field import scan_field
from participants.recovery import Recovery
from participants.sight import Sight
from participants.traits import Traits
from protocols.wheelchair import LASER_RANGE

PATIENCE = 1.5
"""A person tries something else when the chair cannot move for longer than this, s."""

EASING = 0.4
"""Time constant with which a person releases the stick, and takes it again, s."""

REACHED = 0.1
"""A corner is reached this far before its start, m."""


class LapBehaviour:
    """A person in one lap.

    Parameters
    ----------
    traits
        How this person drives.
    skilled
        How practised in this lap.
    response
        What the person knows about how the chair turns; it is updated in every step.
    hesitation
        How long the person stops because the chair turns less than asked.
    room
        The room.
    rng
        The stick's random numbers in this lap.
    compliance
        Share of the deflection given up while a ``demonstrator`` or a ``model`` drives, where it
        is another than the trait's.
    """

    def __init__(
        self,
        traits: Traits,
        skilled: Skill,
        response: TurnResponse,
        hesitation: Hesitation,
        *,
        room: KnownRoom,
        rng: np.random.Generator,
        compliance: Mapping[str, float] | None = None,
    ) -> None:
        self._traits = traits
        self._compliance = compliance or {}
        self._skill = skilled
        self._response = response
        self._hesitation = hesitation
        self._room = room
        self._view = DelayedView(traits.reaction_delay_s)
        self._lever = Stick(traits.stick_lag_s, traits.motor_noise, rng)
        self._recovery = Recovery(room.raster, PATIENCE)
        self._t: float | None = None
        self._arc: float | None = None
        self._stick = STILL
        self._wanted = STILL
        self._kept_share = 1.0
        self._hesitated: dict[Corner, float] = {}

    def act(self, sight: Sight) -> Command:
        """Move the stick."""
        passed = 0.0 if self._t is None else sight.t - self._t
        self._t = sight.t
        view = self._view.see(sight)
        self._response.observe(self._stick, sight.velocity, passed, trusted=not sight.helped)
        situation = self._situation(view)
        intention = self._getting_free(sight, situation.error)
        if intention is None:
            intention = self._driving(view, situation, passed)
        # Somebody else drives: one gives up a part of the deflection, and takes it back later.
        given_up = self._compliance.get(view.helper, self._traits.compliance)
        kept = 1.0 - given_up * view.helped
        self._kept_share += (1.0 - math.exp(-passed / EASING)) * (kept - self._kept_share)
        eased = Command(intention.v * self._kept_share, intention.w * self._kept_share)
        self._stick = self._lever.move(eased, passed)
        return self._stick

    def _situation(self, view: Sight) -> Situation:
        route = self._room.route
        arc = route.locate(view.pose, view.gates_passed, self._arc).arc
        self._arc = arc
        speed = max(view.velocity.v, 0.0)
        ahead = aiming_distance(self._traits, speed)
        error = aim(self._room, view.pose, arc, ahead, self._traits.lane_offset_m)
        corner = next((c for c in self._room.corners if c.end > arc), None)
        return Situation(arc, speed, error, corner)

    def _driving(self, view: Sight, situation: Situation, passed: float) -> Command:
        self._wanted = STILL
        if self._hesitates(view, situation, passed):
            return STILL
        intention = intend(self._traits, self._skill, self._response, self._room.route, situation)
        self._wanted = intention
        w = intention.w * self._response.share_for(intention.w)
        field = scan_field(view.ranges, view.bearings, view.laser, LASER_RANGE)
        careful = slowed(field, Command(intention.v, w), self._traits.clearance_m)
        return Command(careful.v, intention.w)

    def _hesitates(self, view: Sight, situation: Situation, passed: float) -> bool:
        """Whether the person stops at a sharp corner, to look or because the chair turns less."""
        corner = situation.corner
        if corner is None or situation.arc < corner.start - REACHED or view.helped:
            return False
        spent = self._hesitated.get(corner, 0.0)
        if spent >= self._skill.pause + self._hesitation.due(corner):
            return False
        self._hesitated[corner] = spent + passed
        return True

    def _getting_free(self, sight: Sight, error: float) -> Command | None:
        """Return the movement the person tries to get free; None when the chair can move."""
        if sight.helped:
            self._recovery.helped()
            return None
        return self._recovery.movement(sight, self._wanted, error, self._response.share_for)
