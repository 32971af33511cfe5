"""How good live sessions were, and exclusions by the declared rules, applied by the analysis."""

import json

import numpy as np
import pyarrow.parquet as pq
import pytest

from analysis.frames import study_frames
from analysis.live_quality import live_quality
from analysis.report.write import write_report
from protocols.load import load_protocol
from protocols.record.merge import PARTICIPANTS_TABLE
from protocols.record.reader import open_study


@pytest.fixture
def ruled(tmp_path):
    """Return the path of a four-lap protocol with rules about the link."""
    data = load_protocol("four-lap").model_dump(mode="json", by_alias=True)
    rules = {"max_late_share": 0.05, "max_input_age_s": 0.3, "max_interruptions": 1}
    data["exclusion"] |= rules
    path = tmp_path / "ruled.yaml"
    path.write_text(json.dumps(data))
    return path


@pytest.fixture
def live_study(make_study, ruled):
    """Return a live study in which one person's steps were late, and another's laps were held."""
    poor = {"late_share": 0.2, "input_age_p99_s": 0.1, "pauses": 0, "paused_s": 0.0}
    held = {"late_share": 0.0, "input_age_p99_s": 0.1, "pauses": 1, "paused_s": 4.0}
    return make_study(ruled, living=True, participants=4, links={2: poor, 3: held})


def test_the_analysis_applies_the_rules_to_the_laps(live_study):
    """Late steps and interruptions above what the protocol declared exclude, and say why."""
    study = live_study
    header = study.folder / "study.yaml"
    text = header.read_text().replace("origin: live", "origin: elsewhere")
    header.write_text(text)
    table = pq.read_table(study.folder / PARTICIPANTS_TABLE)
    pq.write_table(
        table.drop_columns(["excluded", "exclusion_reason"]), study.folder / PARTICIPANTS_TABLE
    )
    people = study_frames(open_study(study.folder)).everybody
    reasons = dict(zip(people["participant"], people["exclusion_reason"], strict=True))
    assert reasons["P0002"] == "20.0% of a lap's steps were late; the protocol allows 0.05"
    assert reasons["P0003"] == "4 laps interrupted; the protocol allows 1"
    assert people["excluded"].tolist() == [False, True, True, False]


def test_every_person_is_described_from_the_steps(live_study):
    """Medians and percentiles are those of all steps of the analysed laps."""
    study = live_study
    found = live_quality(study_frames(study))
    laps = study.laps.to_pandas()
    own = laps[(laps["participant"] == "P0002") & ~laps["practice"]]["lap"]
    late = np.concatenate([study.steps("P0002", lap)["late_s"].to_numpy() for lap in own])
    trips = np.concatenate(
        [study.steps("P0002", lap)["driver_round_trip_s"].to_numpy() for lap in own]
    )
    row = found.people.set_index("participant").loc["P0002"]
    assert row["steps"] == len(late)
    assert row["late_ms_p99"] == pytest.approx(1000 * np.quantile(late, 0.99))
    assert row["round_trip_ms_p50"] == pytest.approx(1000 * np.median(trips))
    assert row["late_share"] == 0.2
    rules = found.rules.set_index("rule")
    assert rules.loc["max_late_share", "who"] == "P0002"
    assert rules.loc["max_interruptions", "who"] == "P0003"
    assert rules.loc["max_input_age_s", "above"] == 0


def test_the_report_has_the_section(live_study):
    """Live session quality is in the page, the tables and the statistics."""
    study = live_study
    page = write_report(study.folder)
    assert "Live session quality" in page.read_text()
    assert (page.parent / "tables" / "live_quality.csv").exists()
    assert (page.parent / "figures" / "live_quality.svg").exists()
    assert json.loads((page.parent / "statistics.json").read_text())["live_quality"]["people"]


def test_a_simulated_study_has_no_such_section(study):
    """Where nobody living took part there is nothing to say."""
    assert live_quality(study_frames(study)) is None
