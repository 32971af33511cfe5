"""The statistics as JSON, for further computation."""

import json
import math
from dataclasses import fields, is_dataclass
from typing import Any

import numpy as np
import pandas as pd

from analysis.results import StudyResults
from analysis.versions import analysis_versions, recording_versions


def statistics_json(results: StudyResults) -> str:
    """Return every test, estimate and flow count as JSON; what is missing or infinite is null."""
    study = results.frames.study
    content = {
        "schema": 1,
        "study": {
            "protocol": study.protocol.name,
            "course": study.course.name,
            "seed": study.seed,
            "digest": study.header.digest,
        },
        "versions": {
            "analysis": analysis_versions(),
            "recording": recording_versions(study),
        },
        "flow": results.flow,
        "nobody_finished": results.unfinished,
        "laps_without_steps": results.records.without_steps,
        "not_read": (*results.frames.unread, *results.records.damaged),
        "gaps_in_steps": results.records.gaps,
        "misplaced": results.records.misplaced,
        "repaired": study.remarks,
        "exclusions": results.frames.exclusions.remarks,
        "declared_comparisons": results.declared,
        "declared_between_groups": results.between,
        "declared_without_exclusion": results.without_rule,
        "carry_over": results.carry_over,
        "groups": results.groups,
        "registered": results.registered,
        "lap_times": results.lap_times,
        "mixed_model": results.model,
        "own_contrasts": results.contrasts,
        "practice": results.practice,
        "map_overlap": results.overlap,
        "surveys": {s.instrument.name: s.comparisons for s in results.surveys},
        "scales": {s.instrument.name: s.scales for s in results.surveys},
        "measures": results.measures,
        "sections": results.sections,
        "reliability": results.reliability,
        "against_the_paper": results.paper,
    }
    if results.live is not None:
        content["live_quality"] = results.live
    if results.people is not None:
        content["side_by_side"] = {"times": results.people.times, "answers": results.people.answers}
    return json.dumps(plain(content), indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def plain(value: Any) -> Any:
    """Return dataclasses, frames and arrays as lists, mappings, text and finite numbers."""
    if is_dataclass(value) and not isinstance(value, type):
        return {field.name: plain(getattr(value, field.name)) for field in fields(value)}
    if isinstance(value, pd.DataFrame):
        return [plain(row) for row in value.to_dict("records")]
    if isinstance(value, dict):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple | np.ndarray):
        return [plain(item) for item in value]
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value
