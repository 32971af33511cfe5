"""The grid, its cells' people, and what is shipped agree."""

import pytest
from cohort.grid import CALIBRATED, CENTRE, TARGETS, Cell, cells, load, overrides, population, save

from participants.population import PEOPLE, Marginal

SOLVED = {name: Marginal(1.0, 0.5) for name in CALIBRATED}


def test_the_centre_is_the_shipped_prior():
    """The first cell is the shipped cohort's medians; all others are around it, once each."""
    grid = list(cells())
    assert grid[0] == Cell(*CENTRE)
    assert len(set(grid)) == len(grid) == 9
    medians = (PEOPLE.marginals[n].median for n in ("practice_exponent", "corner_share"))
    assert tuple(medians) == CENTRE


def test_only_the_published_lap_figures_are_targets():
    """No assisted lap is calibrated on."""
    assert {name.split()[0] for name in TARGETS} == {"baseline", "limited"}


def test_a_cell_differs_in_its_medians_and_keeps_the_shipped_spreads():
    """Nothing but the free medians and what was solved for changes."""
    people = population(Cell(0.25, 0.85), SOLVED).marginals
    changed = {n for n, marginal in people.items() if marginal != PEOPLE.marginals[n]}
    assert changed == {"practice_exponent", "corner_share", *CALIBRATED}
    assert people["corner_share"] == Marginal(0.85, PEOPLE.marginals["corner_share"].spread)


def test_a_protocol_can_say_who_a_cells_people_are():
    """As ``cohort.traits`` has them."""
    given = overrides(Cell(1.0, 0.35), SOLVED)
    assert given["practice_exponent"] == {"median": 1.0, "spread": 0.5}
    assert given["inexperience"] == {"median": 1.0, "spread": 0.5}


def test_what_was_solved_is_read_as_it_was_written(tmp_path):
    """The file keeps every cell."""
    solved = dict.fromkeys(cells(), SOLVED)
    save(solved, tmp_path / "cells.json")
    assert load(tmp_path / "cells.json") == solved


@pytest.mark.parametrize("name", CALIBRATED)
def test_calibrated_traits_exist(name):
    """They are traits of the population."""
    assert name in PEOPLE.marginals
