"""The further sections of a whole reproduction, from made-up studies."""

import json

import numpy as np
import pandas as pd
import pytest

from analysis.report.blocks import Page
from analysis.reproduction import lessons
from analysis.reproduction.full import full_sections
from analysis.reproduction.generalisation.evidence import Elsewhere
from analysis.reproduction.generalisation.tables import course_table, section_table
from analysis.reproduction.robustness import cost, evidence
from analysis.reproduction.robustness.evidence import Tried
from analysis.reproduction.robustness.table import variant_table
from analysis.reproduction.teaching import maker
from analysis.reproduction.write import contents_of
from harness.reproduction.full import full_experiments
from lad.lad_assistant import LADAssistant
from protocols.files.dump import to_yaml
from protocols.files.errors import InputError
from protocols.variants import VARIANTS

SOME = tuple(v for v in VARIANTS if v.name in ("default", "threshold-0.3", "memoryless"))


@pytest.fixture(scope="module")
def whole(write_made_up, tmp_path_factory):
    """Return a folder of made-up studies, and what was said of it twice over."""
    folder = tmp_path_factory.mktemp("whole")
    for protocol, participants in (("rd-laps", 2), ("rd-accuracy", 1)):
        write_made_up(folder / "studies" / protocol, protocol, participants)
    wanted = {v.name for v in SOME} | {"lab-office-mirror", "ward-corridor"}
    for experiment in full_experiments(folder, 1):
        if experiment.folder.name in wanted:
            path = folder / f"{experiment.folder.name}.yaml"
            path.write_text(to_yaml(experiment.run.study.protocol))
            write_made_up(experiment.folder, str(path), 2)
            path.unlink()
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(evidence, "VARIANTS", SOME)
        patch.setattr(cost, "VARIANTS", SOME)
        patch.setattr(lessons, "PERMUTATIONS", 2)
        first, again = full_sections(folder), full_sections(folder)
    return folder, first, again


def test_the_page_is_the_same_when_written_again(whole):
    """Every file, byte by byte: the measured cost of a step is kept in a file of its own."""
    folder, *both = whole
    one, two = (contents_of(Page("t", "s", sections), rows) for sections, rows in both)
    assert one == two
    kept = json.loads((folder / "cost_per_step.json").read_text())
    assert kept.keys() == {v.name for v in SOME}
    assert all(us > 0 for us in kept.values())


def test_cost_is_in_no_row(whole):
    """The JSON of rows holds nothing that differs from run to run."""
    _, (_, rows), _ = whole
    assert not any("µs" in row.unit or "cost" in row.quantity for row in rows)


def test_every_quantity_has_one_row_without_a_verdict(whole):
    """Names differ; nothing here was declared beforehand."""
    _, (_, rows), _ = whole
    names = [row.quantity for row in rows]
    assert len(set(names)) == len(names)
    assert {row.verdict for row in rows} == {"none"}
    for variant in SOME:
        assert f"auc after 1, {variant.label}" in names
        assert f"rd lap model after 3, {variant.label}" in names
    for course in ("lab-office", "lab-office-mirror", "ward-corridor"):
        assert f"{course} model minus limited" in names
        assert f"{course} model minus demonstrator" in names
    assert "ward-corridor steps helped, soft right" in names
    assert "lab-office-mirror steps helped, left" in names


def test_tables_and_figures_are_there(whole):
    """One row per variant; one per course and condition; a figure for either section."""
    _, (sections, _), _ = whole
    page = Page("t", "s", sections)
    tables = {t.name: t for t in page.tables}
    assert len(tables["robustness"].rows) == len(SOME)
    assert len(tables["generalisation"].rows) == 3 * 4
    assert {p.name for p in page.pictures} == {"robustness", "generalisation"}


def test_a_missing_study_is_named(whole, tmp_path):
    """One line that says which folder is not there."""
    with pytest.raises(InputError, match="rd-accuracy"):
        full_sections(tmp_path)


def test_every_variant_can_be_taught():
    """Each makes a fresh model with the variant's parameters."""
    for variant in VARIANTS:
        model = maker(variant.model)()
        model.start_lap()
        assert not model.assist(np.zeros(19)).helping
        if type(model) is LADAssistant and variant.group != "baseline":
            assert model.parameters == variant.model.parameters


def test_the_variants_are_those_that_were_announced():
    """Equation (10), W_h, capacity, depth, lengthscales, reach, corrections, baselines."""
    assert lessons.PERMUTATIONS == 15
    assert [v.name for v in VARIANTS] == [
        "default", "probability-paper",
        "threshold-0.3", "threshold-0.4", "threshold-0.6", "threshold-0.7",
        "capacity-100", "capacity-200", "depth-2", "depth-8",
        *(f"lengthscale_{group}-{way}"
          for group in ("user", "velocity", "laser") for way in ("halved", "doubled")),
        "reach", "correction", "correction-evidence",
        "linear", "neighbours", "network", "network-refitted", "memoryless",
    ]  # fmt: skip
    assert [v.name for v in VARIANTS if v.same_probabilities] == [
        f"threshold-{w}" for w in (0.3, 0.4, 0.6, 0.7)
    ]


def _tried(variant, laps, aucs):
    accuracy = pd.DataFrame(
        [
            {"run": run, "demonstrations": n, "test": n == 2, "auc": auc, "rmse_v": 0.1,
             "rmse_w": 0.2, "brier": 0.05, "undecided": 0.0}
            for run, auc in enumerate(aucs) for n in range(3)
        ]
    )  # fmt: skip
    names = [f"P{i}" for i in range(len(laps))]
    frame = pd.DataFrame({"model after 1": laps, "model after 3": laps}, index=names)
    return Tried(
        variant, accuracy, frame, frame < 300, {"model after 1": 0.1, "model after 3": 0.0}
    )


def test_changes_are_paired_and_unfinished_laps_counted():
    """By hand: one of three laps runs out of its 300 s; AUC the same in every order."""
    default = _tried(VARIANTS[0], [40.0, 50.0, 60.0], [0.9, 0.95])
    other = _tried(VARIANTS[1], [41.0, 51.5, 300.0], [0.9, 0.95])
    row = variant_table([default, other]).iloc[1]
    assert row["d_lap_1"] == pytest.approx((1 + 1.5 + 240) / 3)
    assert (row["lap_1_n"], row["lap_1_unfinished"]) == (3, 1)
    assert (row["d_auc_1"], row["d_auc_1_low"], row["d_auc_1_high"]) == (0, 0, 0)
    assert row["auc_1"] == pytest.approx(0.925)


def test_shares_of_help_are_means_over_replicates():
    """By hand: two replicates, half and all of their steps helped; shares stay below 1."""
    shares = pd.DataFrame(
        [["P1", "left", 10, 0.5, 0.0], ["P2", "left", 30, 1.0, 0.0]],
        columns=["participant", "kind", "steps", "assisted", "would"],
    )
    laps = pd.DataFrame({"baseline": [1.0, 2.0], "limited": [9.0, 9.5],
                         "demonstrator": [4.0, 4.0], "model": [5.0, 6.0]})  # fmt: skip
    course = Elsewhere("hall", ("left",), laps, laps > 0, shares)
    row = section_table([course]).iloc[0]
    assert (row["assisted"], row["n"], row["high"], row["would"]) == (0.75, 2, 1.0, 0.0)
    model = course_table([course]).set_index("condition").loc["model"]
    assert model["over_limited_s"] == pytest.approx(-3.75)
    assert model["over_demonstrator_s"] == pytest.approx(1.5)
