"""What models are taught: the demonstrations of ``rd-accuracy``, and the orders they come in."""

from dataclasses import dataclass
from pathlib import Path

from analysis.randomness import generator
from analysis.reproduction.demonstrations import Demonstration, demonstrations
from analysis.reproduction.teaching import permutations
from protocols.record.reader import Study, open_study

STUDIES = "studies"
"""The folder of a reproduction that holds its study directories, each by its protocol's name."""

PERMUTATIONS = 15
"""Random orders the demonstrations are taught in (section IV.D)."""


@dataclass(frozen=True, slots=True)
class Lessons:
    """Recorded demonstrations, and random orders of them.

    Attributes
    ----------
    study
        Where they were recorded; its seed draws the orders.
    laps
        The demonstrations, in the order driven.
    orders
        Each a permutation of the places in ``laps``.
    """

    study: Study
    laps: tuple[Demonstration, ...]
    orders: tuple[tuple[int, ...], ...]


def lessons(folder: Path) -> Lessons:
    """Return what every model of a reproduction is taught, in the same orders for all.

    Parameters
    ----------
    folder
        The reproduction's.

    Raises
    ------
    InputError
        When the study is not there or cannot be used.
    """
    study = open_study(folder / STUDIES / "rd-accuracy")
    laps = demonstrations(study)
    return Lessons(
        study, laps, permutations(len(laps), PERMUTATIONS, generator(study, "permutations"))
    )
