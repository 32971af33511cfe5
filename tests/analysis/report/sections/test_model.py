"""Model quality: the AUC of whole laps, and of how many."""

from analysis.report.sections.model import model_section
from analysis.results import analyse


def test_unfinished_laps_have_no_auc_here_and_none_beside_the_paper(make_study):
    """Both sections count the same laps: three of four are finished."""
    results = analyse(make_study(participants=4, unfinished=frozenset({(1, 4)})))
    picture = model_section(results).blocks[0]
    assert "model-assisted median AUC" in picture.alternative
    finished = results.measures.set_index(["measure", "condition"])
    assert finished.loc[("when_auc", "model-assisted"), "n"] == 3
    median = finished.loc[("when_auc", "model-assisted"), "median"]
    assert f"model-assisted median AUC {median:.3f} over 3 finished laps" in picture.alternative
