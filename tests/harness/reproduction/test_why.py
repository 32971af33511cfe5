"""The studies of the explanations: each is a shipped study with its own change and no other."""

from harness.reproduction.why import why_experiments
from protocols.explanations import EXPLANATIONS
from protocols.record.identity import differences
from protocols.shipped_parts import CORRECTION


def test_each_explanation_changes_what_it_says_and_nothing_else(tmp_path):
    """Same seed, same laps; only demonstrator, driver, model or laser differ from the unchanged."""
    planned = dict(zip([e.name for e in EXPLANATIONS], why_experiments(tmp_path, 3), strict=True))
    allowed = ("protocol.name", "protocol.title", "protocol.cohort.", "protocol.model.",
               "protocol.laser.model_reach_m")  # fmt: skip
    for explanation in EXPLANATIONS:
        base = planned["shipped" if explanation.study == "rd-laps" else "people"].run
        run = planned[explanation.name].run
        found = differences(base.study, base.seed, run.study, run.seed)
        assert all(line.startswith(allowed) for line in found)
        changed = (
            explanation.demonstrator
            or explanation.driver
            or explanation.name in ("reach", "laser", "neighbours", "correction")
        )
        assert bool([line for line in found if "title" not in line and "name" not in line]) == bool(
            changed
        )
    assert planned["correction"].run.study.protocol.model.use == CORRECTION
    assert planned["laser"].run.study.protocol.laser.model_reach_m == 2.0
    folders = {e.folder for e in planned.values()}
    assert len(folders) == len(EXPLANATIONS)


def test_people_are_the_cohorts_own_with_another_stick(tmp_path):
    """The driver keeps its other options; the practice lap stays practice."""
    run = why_experiments(tmp_path, 3)[[e.name for e in EXPLANATIONS].index("stick")].run
    protocol = run.study.protocol
    assert protocol.cohort.driver.use == "human"
    assert protocol.cohort.driver.options == {
        "compliance_to_person": 0.75,
        "compliance_to_machine": 0.0,
    }
    assert next(lap.practice for lap in protocol.laps)
