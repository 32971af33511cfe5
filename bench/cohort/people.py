"""People to learn from: of every kind, and of the populations that were solved for."""

from collections.abc import Mapping
from dataclasses import fields

import numpy as np
from cohort.emulator import draw_columns
from cohort.grid import Cell, population
from cohort.lap_pairs import patient

from participants.population import PEOPLE, TRAITS, Marginal, Population
from participants.traits import Traits

SEED = 20140901
"""Of everything the calibration draws; no study's people are used for it."""

WIDE = {
    "preferred_speed_m_s": Marginal(0.5, 1.2),
    "corner_speed_m_s": Marginal(0.18, 1.2),
    "corner_deflection": Marginal(0.75, 1.6),
    "corner_pause_s": Marginal(1.0, 1.2),
    "inexperience": Marginal(0.5, 2.0),
    "corner_share": Marginal(0.55, 1.5),
    "practice_exponent": Marginal(0.5, 1.2),
    "adaptation_per_s": Marginal(0.8, 1.0),
    "limit_push": Marginal(0.6, 1.8),
    "limit_pause_s": Marginal(3.0, 1.6),
}
"""People of every kind differ more than those of any population that is asked about."""

Numbered = list[tuple[int, Traits]]
"""People with their numbers, by which their laps' random numbers are drawn."""


def of_every_kind(people: int) -> Numbered:
    """Return people of every kind, whose traits do not correlate."""
    return _drawn(Population({**PEOPLE.marginals, **WIDE}, {}), people, first=1)


def of_cell(cell: Cell, solved: Mapping[str, Marginal], people: int, first: int) -> Numbered:
    """Return people of a solved population, numbered from ``first`` on."""
    return _drawn(population(cell, solved), people, first)


def _drawn(population: Population, people: int, first: int) -> Numbered:
    """Return people with a patience that does not end: slow laps teach, too."""
    latent = np.random.default_rng([SEED, first]).normal(size=(people, len(TRAITS)))
    columns = draw_columns(population, latent)
    names = [field.name for field in fields(Traits)]
    return [
        (first + i, patient(Traits(**{name: float(columns[name][i]) for name in names})))
        for i in range(people)
    ]
