"""The emulator learns what lap time follows from traits, and solving finds what made figures."""

import numpy as np
import pytest
from cohort.emulator import LapTime, as_columns, draw_columns, features
from cohort.grid import CALIBRATED, TARGETS, Cell, population
from cohort.people import of_cell, of_every_kind
from cohort.solve import Crowd, expected, marginals, solve

from participants.population import PEOPLE, TRAITS, Marginal


def made_up(columns, lap, noise=0.0, seed=0):
    """Return lap times after a formula that has the real thing's shape, s."""
    excess = columns["inexperience"] * (lap + 1.0) ** -columns["practice_exponent"]
    seconds = 18.0 / columns["preferred_speed_m_s"] * (1.0 + excess)
    if lap > 1:
        seconds = seconds + 24.0 + 2.0 * columns["limit_pause_s"]
    return seconds * np.exp(noise * np.random.default_rng(seed).normal(size=len(seconds)))


@pytest.fixture(scope="module")
def learnt():
    """Return both laps, learnt from 120 people of every kind."""
    columns = as_columns([traits for _, traits in of_every_kind(120)])
    return tuple(LapTime(columns, made_up(columns, lap, 0.02, lap), lap) for lap in (1, 2))


def test_lap_times_of_other_people_are_foretold(learnt):
    """Within a few per cent, for people of the shipped population who taught nothing."""
    latent = np.random.default_rng(9).normal(size=(300, len(TRAITS)))
    columns = draw_columns(PEOPLE, latent)
    for lap in (1, 2):
        off = learnt[lap - 1].log_seconds(columns) - np.log(made_up(columns, lap))
        assert np.std(off) < 0.08
        assert abs(np.mean(off)) < 0.03


def test_luck_is_told_from_traits(learnt):
    """The noise that no trait explains is found."""
    for lap in learnt:
        assert lap.noise == pytest.approx(0.02, rel=0.7)


def test_columns_are_the_populations_people():
    """Traits drawn together are those drawn one by one."""
    latent = np.random.default_rng(2).normal(size=(5, len(TRAITS)))
    columns = draw_columns(PEOPLE, latent)
    for i in range(5):
        one = PEOPLE.values(latent[i])
        assert {name: columns[name][i] for name in TRAITS} == pytest.approx(one)


def test_solving_gives_the_four_figures(learnt):
    """What is solved for shows the published figures, as far as the emulator can tell."""
    crowd, cell = Crowd(people=1024), Cell(0.5, 0.6)
    solved = solve(cell, learnt, crowd)
    assert set(solved) == set(CALIBRATED)
    figures = expected(cell, solved, learnt, crowd)
    assert figures == pytest.approx(list(TARGETS.values()), rel=0.02)


def test_unfinished_laps_are_left_out(learnt):
    """No person with a patience of half a minute finishes a limited lap that counts long laps."""
    crowd, cell = Crowd(people=256), Cell(0.5, 0.6)
    solved = {"inexperience": Marginal(0.5, 1.5), "limit_pause_s": Marginal(2.0, 1.0)}
    patient = expected(cell, solved, learnt, crowd)
    hasty = expected(cell, {**solved, "patience_s": Marginal(60.0, 0.1)}, learnt, crowd)
    assert hasty[2] < patient[2]


def test_unknowns_are_medians_and_spreads():
    """Half of the range for zero, a spread of one for its logarithm."""
    found = marginals(np.zeros(4))
    assert found["limit_pause_s"] == Marginal(30.0, 1.0)


def test_people_to_learn_from_repeat_and_differ():
    """Each portion of people is its own, and the same every time."""
    cell = Cell(0.5, 0.6)
    some, same, others = (of_cell(cell, {}, 4, first) for first in (10, 10, 20))
    assert some == same
    assert [number for number, _ in others] == [20, 21, 22, 23]
    assert some[0][1] != others[0][1]
    assert population(cell, {}).marginals == PEOPLE.marginals


def test_features_tell_the_laps_apart():
    """Practice makes a lap's features, and only the limited lap has those of being limited."""
    columns = draw_columns(PEOPLE, np.zeros((1, len(TRAITS))))
    assert features(columns, 2).shape[1] == features(columns, 1).shape[1] + 3
