"""What is calibrated, on what, and over which grid of the two things nothing published tells.

The grid is declared here, and was before any assisted lap of a calibrated cohort was driven.
"""

import json
from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass
from pathlib import Path

from participants.population import PEOPLE, Marginal, Population

TARGETS = {
    "baseline mean": 48.5,
    "baseline sd": 20.0,
    "limited mean": 76.7,
    "limited sd": 24.8,
}
"""The only figures the cohort is calibrated on, s: Soh & Demiris (2013), section V.B."""

TOLERANCES = {"mean": 0.05, "sd": 0.10}

CALIBRATED = ("inexperience", "limit_pause_s")
"""Traits whose medians and spreads are solved for: two each, for four figures."""

PRACTICE = (0.25, 0.5, 1.0)
"""Medians of the practice exponent: half and twice the prior's."""

CORNERS = (0.35, 0.6, 0.85)
"""Medians of the share of inexperience that sits in sharp corners: as far below as above."""

CENTRE = (0.5, 0.6)
"""The prior's medians: the shipped cohort."""

FILE = Path(__file__).with_name("cells.json")


@dataclass(frozen=True, order=True)
class Cell:
    """One pair of medians of the two free traits."""

    practice: float
    corners: float

    @property
    def name(self) -> str:
        """Return the cell as files and tables name it."""
        return f"practice {self.practice:g}, corners {self.corners:g}"


def cells() -> Iterator[Cell]:
    """Go through the grid, its centre first."""
    yield Cell(*CENTRE)
    for practice in PRACTICE:
        for corners in CORNERS:
            if (practice, corners) != CENTRE:
                yield Cell(practice, corners)


def population(cell: Cell, solved: Mapping[str, Marginal]) -> Population:
    """Return the people of a cell: its medians, the shipped spreads, the calibrated traits."""
    free = {
        name: Marginal(median, PEOPLE.marginals[name].spread)
        for name, median in (
            ("practice_exponent", cell.practice),
            ("corner_share", cell.corners),
        )
    }
    return PEOPLE.with_marginals({**free, **solved})


def overrides(cell: Cell, solved: Mapping[str, Marginal]) -> dict[str, dict[str, float]]:
    """Return a cell's people as a protocol's ``cohort.traits``."""
    people = population(cell, solved).marginals
    names = ("practice_exponent", "corner_share", *CALIBRATED)
    return {name: asdict(people[name]) for name in names}


def save(solved: Mapping[Cell, Mapping[str, Marginal]], path: Path = FILE) -> None:
    """Write what was solved for each cell."""
    rows = [
        {**asdict(cell), **{name: asdict(marginal) for name, marginal in found.items()}}
        for cell, found in solved.items()
    ]
    path.write_text(json.dumps(rows, indent=1) + "\n")


def load(path: Path = FILE) -> dict[Cell, dict[str, Marginal]]:
    """Return what was solved for each cell."""
    return {
        Cell(row["practice"], row["corners"]): {name: Marginal(**row[name]) for name in CALIBRATED}
        for row in json.loads(path.read_text())
    }
