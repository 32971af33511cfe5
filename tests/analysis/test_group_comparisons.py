"""Declared comparisons of groups: what is compared, Holm over both kinds, and what is refused."""

from dataclasses import replace

import numpy as np
import pytest

from analysis.attainable import out_of_reach
from analysis.comparisons import declared_results
from analysis.frames import study_frames
from analysis.group_comparisons import people_values
from analysis.report.sections.between import between_sentence, between_table
from analysis.stats.holm import holm
from analysis.stats.rank_sum import rank_sum
from protocols.declared import Comparison
from protocols.files.fault import InconsistentError
from protocols.groups import Group
from protocols.study import StudyProtocol

GROUPS = {"usual": Group(), "eager": Group()}
SLOWER = Comparison(name="eager people are slower", condition="limited", groups=("eager", "usual"),
                    kind="confirmatory")  # fmt: skip
HELPED = Comparison(name="eager help helps more", condition="model-assisted", reference="limited",
                    groups=("eager", "usual"), kind="confirmatory")  # fmt: skip
WITHIN = Comparison(name="the model helps", condition="model-assisted", reference="limited",
                    kind="confirmatory")  # fmt: skip


def with_groups(frames, analyses):
    """Return a study in two groups, every other person in each, that declares some analyses."""
    changes = {"groups": GROUPS, "analyses": analyses}
    protocol = frames.study.protocol.model_copy(update=changes)
    header = frames.study.header.model_copy(update={"protocol": protocol})
    of = {who: ("usual", "eager")[i % 2] for i, who in enumerate(frames.everybody["participant"])}
    everybody = frames.everybody.assign(group=frames.everybody["participant"].map(of))
    return replace(frames, study=replace(frames.study, header=header), everybody=everybody)


@pytest.fixture
def frames(make_study):
    """Return ten people in two groups; one of the second did not finish the limited lap."""
    study = make_study(participants=10, unfinished=frozenset({(4, 2)}))
    return with_groups(study_frames(study), (SLOWER, HELPED, WITHIN))


def test_each_person_counts_once(frames):
    """In one condition people's log times, in two their log ratios; exact, with who is missing."""
    _, (slower, helped) = declared_results(frames)
    wide = np.log(
        frames.laps.pivot_table(index="participant", columns="condition", values="lap_time_s")
    )
    eager = frames.everybody.set_index("participant")["group"].reindex(wide.index) == "eager"
    limited, change = wide["limited"], wide["model-assisted"] - wide["limited"]
    assert slower.test.p == pytest.approx(rank_sum(limited[eager], limited[~eager]).p)
    assert helped.test.p == pytest.approx(rank_sum(change[eager], change[~eager]).p)
    assert helped.test.estimate == pytest.approx(rank_sum(change[eager], change[~eager]).estimate)
    assert (slower.n, slower.missing) == ((4, 5), 1)
    assert "exact" in slower.test.method


def test_a_family_is_corrected_over_both_kinds(frames):
    """Holm counts within and between together; the smallest p too."""
    within, between = declared_results(frames)
    p = [*(c.p_declared for c in within), *(c.p_declared for c in between)]
    assert [c.p_holm for c in (*within, *between)] == pytest.approx(list(holm(p)))
    assert between[0].smallest_p == pytest.approx(2 * 2 / 126)  # 4 and 5 people, the last of two


@pytest.mark.parametrize("analysis", [SLOWER, HELPED])
def test_an_unfinished_lap_can_be_the_slowest(frames, analysis):
    """Declared as the worst rank, nobody is missing, and the unfinished lap ranks behind all."""
    worst = analysis.model_copy(update={"unfinished": "worst rank"})
    found = people_values(frames, worst)
    assert found.notna().all()
    at = found.idxmax() if analysis is SLOWER else found.idxmin()
    assert at == "P0004"


def test_the_report_says_what_was_compared(frames):
    """A sentence for the first screen, a row for the table."""
    _, between = declared_results(frames)
    assert "eager against usual" in between_sentence(between[0])
    row = between_table(between).iloc[1]
    assert (row["group"], row["reference_group"]) == ("eager", "usual")
    assert row["difference"] == pytest.approx(100 * np.expm1(between[1].test.estimate))


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"groups": ("eager", "lazy")}, "'lazy' is not a group"),
        ({"groups": ("eager", "eager")}, "compared with itself"),
        ({"equivalence_margin": 5.0}, "within participants"),
        ({"groups": None, "reference": None}, "allowed: a condition to compare with, or groups"),
    ],
)
def test_what_compares_nothing_is_refused(study, change, message):
    """One fault, with what is allowed."""
    wrong = HELPED.model_copy(update=change)
    content = dict(study.protocol) | {"groups": GROUPS, "analyses": (wrong,)}
    with pytest.raises(InconsistentError, match=message):
        StudyProtocol.model_construct(**content)._parts_agree()


def test_small_groups_are_warned_about(study):
    """Two groups of three cannot differ significantly: their smallest p is .1."""
    cohort = study.protocol.cohort.model_copy(update={"participants": 6})
    changes = {"groups": GROUPS, "analyses": (SLOWER,), "cohort": cohort}
    (warning,) = out_of_reach(study.protocol.model_copy(update=changes))
    assert "0.1" in warning
    assert "8 people of all groups" in warning
