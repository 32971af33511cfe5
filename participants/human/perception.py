"""A person acts on what there was to see one reaction time earlier."""

from collections import deque

from participants.sight import Sight


class DelayedView:
    """Sights with the delay of a person's reaction.

    Parameters
    ----------
    delay
        From seeing to acting, s.
    """

    def __init__(self, delay: float) -> None:
        self._delay = delay
        self._seen: deque[Sight] = deque()

    def see(self, sight: Sight) -> Sight:
        """Take in the present and return the newest sight that is at least the delay old.

        At the start of a lap, when nothing is that old yet, the first one: people look before
        they set off.
        """
        self._seen.append(sight)
        while len(self._seen) > 1 and self._seen[1].t <= sight.t - self._delay + 1e-9:
            self._seen.popleft()
        return self._seen[0]
