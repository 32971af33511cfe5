"""What a cohort answers tells what moved the answers: statsmodels finds the loadings again."""

import numpy as np
import pytest
from statsmodels.miscmodels.ordinal_model import OrderedModel

from participants.cohort import draw_person
from participants.loadings import DRIVING_ASSISTANCE, impression
from participants.registry import make_respondent
from participants.setup import RespondentSetup
from participants.survey import LapExperience, Question
from protocols.cohort import Cohort

PEOPLE = 2500
QUESTIONS = tuple(Question("driving-assistance", item) for item in DRIVING_ASSISTANCE)


def lap(rng):
    """Return a possible experience of a lap; its values are independent of each other."""
    assisted = float(rng.uniform(0.02, 0.5))
    return LapExperience(
        lap_time=50.0 * float(np.exp(rng.normal(0.2, 0.4))),
        baseline_time=50.0,
        assisted_fraction=assisted,
        interventions=int(rng.integers(1, 8)),
        interference=assisted * float(rng.uniform(0.0, 0.6)),
        collisions=int(rng.integers(0, 4)),
        completed=bool(rng.random() < 0.8),
    )


def survey(cohort):
    """Return what each of many people felt in a lap and liked, their style, and their answers."""
    felt, answers, styles = [], [], []
    for i in range(PEOPLE):
        rng = np.random.default_rng([11, i])
        person, experience = draw_person(cohort, rng), lap(rng)
        respondent = make_respondent("ordinal", RespondentSetup(QUESTIONS, rng, person.style))
        felt.append({**impression(experience), "liking": person.style.liking})
        styles.append(person.style)
        answers.append(respondent.answer(QUESTIONS, experience, rng))
    names = tuple(felt[0])
    x = np.array([[row[name] for name in names] for row in felt])
    y = np.array([[np.nan if a is None else a for a in row] for row in answers])
    return names, x, y, styles


def fitted(x, y):
    """Return an ordered probit's weights; only those who did not answer are left out."""
    there = ~np.isnan(y)
    model = OrderedModel(y[there].astype(int), x[there], distr="probit")
    return model.fit(method="bfgs", disp=False).params[: x.shape[1]]


def declared(names):
    """Return the loadings of each item, shape (11, len(names))."""
    return np.array([[getattr(row, n) for n in names] for row in DRIVING_ASSISTANCE.values()])


@pytest.mark.slow
def test_loadings_come_back_from_a_cohort_with_its_yea_sayers():
    """Of all eleven items, shrunk as unseen acquiescence shrinks a probit's weights."""
    names, x, y, styles = survey(Cohort(traits={"extremity": {"median": 1.0, "spread": 0.0}}))
    habit = np.std([style.acquiescence for style in styles])
    found = np.array([fitted(x, y[:, i]) for i in range(len(QUESTIONS))]) * np.hypot(1.0, habit)
    # Liking varies least between people, so its weight is the least certain.
    allowed = np.where(np.array(names) == "liking", 0.4, 0.3)
    assert (np.abs(found - declared(names)) < allowed).all()


def test_loadings_come_back_in_proportion_from_the_whole_cohort():
    """With each person's own use of the scale the weights shrink, and keep their proportions."""
    names, x, y, _ = survey(Cohort())
    some = [0, 5, 6, 10]
    found = np.array([fitted(x, y[:, i]) for i in some]).ravel()
    assert np.corrcoef(found, declared(names)[some].ravel())[0, 1] > 0.97


@pytest.mark.parametrize("item", range(len(QUESTIONS)))
def test_every_item_depends_on_something_the_lap_shows(item):
    """No item is noise, and none says that slower is better."""
    row = list(DRIVING_ASSISTANCE.values())[item]
    weights = row.model_dump(exclude={"intercept", "liking"})
    assert any(weights.values())
    good = row.slowness <= 0 or list(DRIVING_ASSISTANCE)[item] in {"Q2", "Q4", "Q9"}
    assert good
