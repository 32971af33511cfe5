"""Simulated studies print what the paper prints, and the paper's place among them is right."""

import numpy as np
import pandas as pd
import pytest
from cohort.studies import (
    CONDITIONS,
    JOINT,
    PUBLISHED,
    as_far_out,
    draw_studies,
    predict,
    printed,
    table,
)


def pool(people=200, seed=0):
    """Return lap times of people whose laps scatter around the published means."""
    rng = np.random.default_rng(seed)
    means = [PUBLISHED[f"{name} mean"] for name in CONDITIONS]
    times = np.exp(np.log(means) + 0.15 * rng.normal(size=(people, 4)))
    return pd.DataFrame(times, index=range(1, people + 1), columns=list(CONDITIONS))


def test_a_study_prints_means_sds_gain_and_ratio():
    """By hand, with an unfinished lap left out."""
    times = np.array([[40.0, 80.0, 50.0, 60.0], [50.0, 100.0, 40.0, np.nan]])
    figures = printed(times)
    assert figures["limited mean"] == 90.0
    assert figures["baseline sd"] == pytest.approx(50**0.5)
    assert figures["limited - model"] == 30.0
    assert figures["limited / model"] == 1.5
    assert figures["model - human"] == 15.0


def test_practice_laps_are_left_out_and_unfinished_ones_are_gaps():
    """The table has all people, with what they finished."""
    laps = pd.DataFrame(
        {
            "number": [1, 1, 1, 2],
            "condition": ["familiarisation", "baseline", "limited", "familiarisation"],
            "practice": [True, False, False, True],
            "lap_time_s": [50.0, 45.0, np.nan, 60.0],
        }
    )
    times = table(laps)
    assert list(times.index) == [1, 2]
    assert times.loc[1, "baseline"] == 45.0
    assert times.isna().sum().sum() == 7


def test_studies_have_different_people_and_repeat_with_their_seed():
    """A person takes part once in a study; the same seed draws the same studies."""
    times = pool(people=12)
    studies = draw_studies(times, 20, 12, seed=3)
    assert np.allclose(studies["baseline mean"], times["baseline"].mean())
    large = pool()
    pd.testing.assert_frame_equal(draw_studies(large, 5, 12, 1), draw_studies(large, 5, 12, 1))


def test_intervals_hold_the_truth():
    """Of a pool whose mean is the paper's, the central 95% of studies holds the paper's mean."""
    found = predict(draw_studies(pool(), 200, 12, seed=1))
    for name in ("baseline mean", "limited mean"):
        assert found[name].low < PUBLISHED[name] < found[name].high
        assert 0.2 < found[name].below < 0.9
    assert np.isnan(found["model-assisted sd"].below)


def test_a_paper_like_the_others_is_not_far_out_and_an_unlike_one_is():
    """By the three predicted figures together."""
    rng = np.random.default_rng(5)
    paper = np.log([PUBLISHED[name] for name in JOINT])
    near = pd.DataFrame(np.exp(paper + 0.2 * rng.normal(size=(200, 3))), columns=list(JOINT))
    assert as_far_out(near) > 0.5
    assert as_far_out(1.5 * near.assign(**{JOINT[1]: 9.0 * near[JOINT[1]]})) < 0.02
