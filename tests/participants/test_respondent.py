"""Answers follow an ordered probit model of the lap, in a personal style."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import optimize, stats

from participants.loadings import DRIVING_ASSISTANCE, impression
from participants.registry import make_respondent
from participants.respondent import NO_STYLE, OrdinalRespondent, on_scale
from participants.setup import RespondentSetup
from participants.survey import LapExperience, Question
from protocols.files.errors import InputError

QUESTIONS = tuple(Question("driving-assistance", item) for item in DRIVING_ASSISTANCE)
LOADINGS = {("driving-assistance", item): row for item, row in DRIVING_ASSISTANCE.items()}
CALM = LapExperience(50.0, 50.0, 0.0, 0, 0.0, 0, completed=True)


def answers(lap, style=NO_STYLE, n=400, seed=0):
    """Return n times the answers to all questions about a lap, shape (n, 11), NaN: missing."""
    who, rng = OrdinalRespondent(LOADINGS, style), np.random.default_rng(seed)
    rows = [who.answer(QUESTIONS, lap, rng) for _ in range(n)]
    return np.array([[np.nan if a is None else a for a in row] for row in rows])


@given(st.floats(-50.0, 50.0), st.integers(2, 11))
def test_answers_are_on_the_scale_and_mirror(latent, points):
    """Every latent answer is a point of the scale, and the scale is symmetric."""
    answer = on_scale(latent, points)
    assert 1 <= answer <= points
    if (latent - points / 2) % 1.0 != 0.0:
        assert on_scale(-latent, points) == points + 1 - answer


def test_loadings_are_recovered_from_a_large_cohort():
    """A probit fit to 6,000 people's answers finds the loadings that made them."""
    rng = np.random.default_rng(1)
    who = OrdinalRespondent(LOADINGS)
    item, names = "Q7", ("slowness", "help", "opposition")
    features, given_answers = [], []
    for _ in range(6000):
        lap = LapExperience(
            lap_time=50.0 * float(np.exp(rng.normal(0.2, 0.4))),
            baseline_time=50.0,
            assisted_fraction=0.5 * float(rng.random()),
            interventions=2,
            interference=0.1 * float(rng.random()),
            collisions=0,
            completed=True,
        )
        felt = impression(lap)
        features.append([1.0, *(felt[name] for name in names)])
        given_answers += who.answer([Question("driving-assistance", item)], lap, rng)
    x, y = np.array(features), np.array(given_answers)
    cuts = np.array([-np.inf, -1.5, -0.5, 0.5, 1.5, np.inf])

    def misfit(beta):
        mean = x @ beta
        p = stats.norm.cdf(cuts[y] - mean) - stats.norm.cdf(cuts[y - 1] - mean)
        return -np.log(np.maximum(p, 1e-300)).sum()

    found = optimize.minimize(misfit, np.zeros(4), method="BFGS").x
    row = DRIVING_ASSISTANCE[item]
    assert found == pytest.approx([row.intercept, row.slowness, row.help, row.opposition], abs=0.15)


def test_acquiescence_raises_every_answer():
    """Yea-sayers agree more with statements of either direction."""
    eager = replace(NO_STYLE, acquiescence=1.0)
    assert (answers(CALM, eager).mean(axis=0) > answers(CALM).mean(axis=0) + 0.3).all()


def test_extremity_spreads_the_answers():
    """Who likes the ends uses them more; who avoids them, less."""
    shares = [
        np.isin(answers(CALM, replace(NO_STYLE, extremity=e)), (1, 5)).mean() for e in (0.5, 1, 2)
    ]
    assert shares[0] < shares[1] < shares[2]


def test_liking_concerns_assistance_only():
    """A person who likes assistance answers the items about the task like the others."""
    gap = answers(CALM, replace(NO_STYLE, liking=2.0)).mean(axis=0) - answers(CALM).mean(axis=0)
    assert gap[:4] == pytest.approx(0.0)
    assert gap[QUESTIONS.index(Question("driving-assistance", "Q11"))] > 0.5


def test_missing_answers_come_as_often_as_declared():
    """One item in ten is left out by who leaves out one in ten, and the others stay as they are."""
    gaps = answers(CALM, replace(NO_STYLE, missing_share=0.1), n=1000)
    full = answers(CALM, n=1000)
    assert np.isnan(gaps).mean() == pytest.approx(0.1, abs=0.01)
    answered = ~np.isnan(gaps)
    assert (gaps[answered] == full[answered]).all()


def test_the_same_numbers_make_the_same_answers():
    """Answers are a function of lap, person and generator."""
    assert np.array_equal(answers(CALM, seed=4), answers(CALM, seed=4))


def test_a_limited_lap_is_called_more_difficult():
    """Statement by statement as in the paper: harder, more frustrating than the baseline."""
    limited = replace(CALM, lap_time=80.0)
    gap = answers(limited).mean(axis=0) - answers(CALM).mean(axis=0)
    assert gap[0] < -0.5
    assert gap[1] > 0.5


def test_an_unknown_item_is_refused_before_the_study():
    """An item without loadings is refused; the message tells what to do."""
    setup = RespondentSetup((Question("trust", "T1"),), np.random.default_rng(0))
    with pytest.raises(InputError, match="item 'T1' of instrument 'trust'; allowed: none, or item"):
        make_respondent("ordinal", setup)


def test_own_instruments_bring_their_loadings():
    """A protocol's options make new items answerable, and are checked."""
    question = Question("trust", "T1", points=7)
    options = {"loadings": {"trust": {"T1": {"intercept": 9.0}}}}
    rng = np.random.default_rng(0)
    who = make_respondent("ordinal", RespondentSetup((question,), rng, options=options))
    assert who.answer([question], CALM, rng) == (7,)
    options["loadings"]["trust"]["T1"]["slownes"] = 1.0
    with pytest.raises(InputError, match=r"loadings\.trust\.T1\.slownes"):
        make_respondent("ordinal", RespondentSetup((question,), rng, options=options))
