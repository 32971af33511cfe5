"""A driver with an impairment: what the link of a living driver says is not the impairment's."""

import numpy as np

from lad.command import Command
from participants.driver import Driver, kind_of
from participants.sight import Sight
from participants.telemetry import telemetry_of


class HeardDriver:
    """The driver that an impairment gets: the same one, and it is known whether it answered.

    Parameters
    ----------
    driver
        The driver.
    """

    def __init__(self, driver: Driver) -> None:
        self._driver = driver
        self.kind = kind_of(driver)
        self.telemetry = telemetry_of(driver)
        self.answered = False

    def start_lap(self, lap: int, rng: np.random.Generator) -> None:
        """Get ready for a lap."""
        self._driver.start_lap(lap, rng)

    def act(self, sight: Sight) -> Command | None:
        """Answer as the driver does."""
        answer = self._driver.act(sight)
        self.answered = answer is not None
        return answer


class ImpairedDriver:
    """An impairment around a driver; it says nothing in a step in which its driver says nothing.

    A hand that trembles on after its owner's link is lost must not keep the chair moving: silence
    is counted from the driver's own last command. What the link says is the driver's own, too. So
    no impairment has to remember either.

    Parameters
    ----------
    driver
        The driver that the impairment was made around.
    impairment
        The impairment.

    Attributes
    ----------
    impairment
        As above.
    """

    def __init__(self, driver: HeardDriver, impairment: Driver) -> None:
        self._driver, self.impairment = driver, impairment
        self.kind = kind_of(impairment)
        self.telemetry = driver.telemetry

    def start_lap(self, lap: int, rng: np.random.Generator) -> None:
        """Get ready for a lap."""
        self.impairment.start_lap(lap, rng)

    def act(self, sight: Sight) -> Command | None:
        """Answer with the impaired command; None where the driver has no new one."""
        answer = self.impairment.act(sight)
        return answer if self._driver.answered else None
