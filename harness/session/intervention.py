"""When a demonstrator takes over from a model that helps: only where needed."""

from lad.assistant import Assistance
from lad.command import Command
from protocols.condition import Corrections
from protocols.wheelchair import MAX_SPEED, MAX_TURN_RATE


class Intervention:
    """A demonstrator beside a model that helps, in one lap.

    The demonstrator takes over when it would help and, for longer than its patience, the command
    that would count without it is too far from its own; it hands back when it no longer would
    help. In between the model has control, whatever it does: one who watches does not let go and
    grasp again from step to step.

    Parameters
    ----------
    settings
        As a condition has them.

    Examples
    --------
    >>> at_once = Intervention(Corrections(patience_s=0.0))
    >>> turns = Assistance(helping=True, command=Command(0.2, -0.5))
    >>> at_once.needed(turns, turns, Command(0.2, -0.15), 0.0)
    False
    >>> at_once.needed(turns, Assistance(helping=False), Command(0.2, -0.15), 0.1)
    True
    """

    def __init__(self, settings: Corrections) -> None:
        self._settings = settings
        self._since: float | None = None
        self._intervening = False

    def needed(self, demonstrator: Assistance, model: Assistance, user: Command, t: float) -> bool:
        """Say whether the demonstrator has control in this step.

        Parameters
        ----------
        demonstrator, model
            What both answer.
        user
            The driver's limited command.
        t
            Lap time, s; rising from call to call.
        """
        wanted = demonstrator.command if demonstrator.helping else None
        if wanted is None:
            self._intervening, self._since = False, None
            return False
        given = model.command if model.helping and model.command is not None else user
        off = max(abs(wanted.v - given.v) / MAX_SPEED, abs(wanted.w - given.w) / MAX_TURN_RATE)
        if off <= self._settings.tolerance:
            self._since = None
        elif self._since is None:
            self._since = t
        waited = self._since is not None and t - self._since >= self._settings.patience_s - 1e-9
        self._intervening = self._intervening or waited
        return self._intervening
