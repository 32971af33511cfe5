"""The points of the report's figures lead to the laps behind them."""

import numpy as np
import pytest

from analysis.lap_pages.study_page import held_laps
from analysis.report.sections.lap_times import lap_time_section
from analysis.report.sections.model import model_section
from analysis.report.sections.side_by_side import side_section
from analysis.results import analyse

SECTIONS = [lap_time_section, model_section, side_section]


@pytest.fixture(scope="module")
def results(write_made_up, study, tmp_path_factory):
    """Return a study beside another one, some of whose participants have the same names."""
    folder = tmp_path_factory.mktemp("linked") / "study"
    return analyse(write_made_up(folder, "four-lap", 3), beside=study)


def picture(section, results):
    """Return the section's figure with links, settled."""
    (found,) = [b for b in section(results).blocks if getattr(b, "spots", ())]
    found.figure.draw_without_rendering()
    return found


@pytest.mark.parametrize("section", SECTIONS)
def test_a_link_lies_on_a_point_that_is_drawn(section, results):
    """Whoever sees a point can ask for the lap behind it: no link is beside what it belongs to."""
    found = picture(section, results)
    axes = found.figure.axes[0]
    points = np.vstack([np.asarray(c.get_offsets(), float) for c in axes.collections])
    spots = np.array([(spot.x, spot.y) for spot in found.spots])
    apart = np.hypot(*(spots[:, None] - points[None]).transpose(2, 0, 1))
    assert (np.nanmin(apart, axis=1) < 1e-9).all()


@pytest.mark.parametrize("section", SECTIONS)
def test_a_link_leads_to_the_lap_whose_value_it_has(section, results):
    """The lap has the condition and the time that the point stands for, and is in the page."""
    laps = {f"study.html#{one.key}": one for one in held_laps(results)}
    for spot in picture(section, results).spots:
        one = laps[spot.target]
        assert spot.title.startswith(f"{one.participant}, lap {one.lap}: {one.condition}, ")
        if section is not model_section:
            assert spot.y == one.time_s


def test_laps_of_the_study_beside_have_no_links(results):
    """They lie in another study's page: as many links as laps of this study, and no more."""
    assert len(picture(side_section, results).spots) == len(held_laps(results))
