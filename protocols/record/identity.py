"""What makes two studies the same: protocol, course, instruments and seed."""

import hashlib
import json
from collections.abc import Iterator, Mapping
from typing import Any

from lad.hyperparameters import LADParameters
from protocols.files.document import spoken
from protocols.files.fault import Location
from protocols.live import LiveSettings, QuestionPages
from protocols.resolved import ResolvedStudy
from protocols.wheelchair import LASER_RANGE

_ABSENT = object()

_LATER_LIVE = {
    "questions": QuestionPages().model_dump(mode="json"),
    "allocation": "concealed",
}


_LATER: Mapping[str, Mapping[str, Any]] = {
    "protocol": {
        "hold_s": 0.3,
        "orders": {"use": "fixed", "over": [], "before": [], "list": []},
        "groups": {},
        "models": {},
        "demonstrators": {},
        "registration": None,
        "consent": None,
        "demographics": [],
        "survey": [],
        "debrief": None,
        "live": LiveSettings().model_dump(mode="json", exclude=set(_LATER_LIVE)),
    },
    "live": _LATER_LIVE,
    "consent": {"sharing": False},
    "lap": {"break_s": 0.0, "until_comfortable": False},
    "condition": {"model": "own", "corrections": None, "latent_h": None, "demonstrator": "own"},
    "exclusion": {"max_late_share": None, "max_input_age_s": None, "max_interruptions": None},
    "item": {
        "answer": "point",
        "lowest": None,
        "highest": None,
        "step": None,
        "ends": None,
        "expected": None,
    },
    "instrument": {"score": None},
    "analysis": {"margin_reason": "", "unfinished": "complete pairs", "groups": None},
    "group": {"course": None},
    "limitation": {"left_turn_rad_s": None, "speed_m_s": None, "lag_s": 0.0, "dead_zone": 0.0},
    "parameters": LADParameters.later_defaults(),
    "laser": {"model_reach_m": LASER_RANGE},
}
"""Fields that came after the first version, with their defaults. A study that does not use them
is the study it was: its digest and its record stay the same."""

_ABOUT = ("replicates",)
"""Fields of a protocol that only say what its report shows beside it: not part of the study."""


def study_digest(study: ResolvedStudy, seed: int) -> str:
    """Return the SHA-256 of everything but the participant's number that a session depends on.

    The number of participants is left out: a study can be enlarged.
    """
    return identity_digest(identity(study, seed))


def identity_digest(content: Mapping[str, Any]) -> str:
    """Return the SHA-256 of a study's identity."""
    text = json.dumps(content, sort_keys=True, separators=(",", ":"))
    return hashlib.sha256(text.encode()).hexdigest()


def differences(
    here: ResolvedStudy, here_seed: int | None, wanted: ResolvedStudy, wanted_seed: int
) -> tuple[str, ...]:
    """Return in words how a recorded study differs from the one that is wanted; empty when not.

    Examples of an entry: ``seed: 0 there, 1 wanted``;
    ``protocol.conditions.limited.limitation.right_turn_rad_s: 0.15 there, 0.2 wanted``.
    """
    return identity_differences(identity(here, here_seed), identity(wanted, wanted_seed))


def identity_differences(here: Mapping[str, Any], wanted: Mapping[str, Any]) -> tuple[str, ...]:
    """Return in words how two studies' identities differ; empty when they do not."""
    pairs = _unequal(here, wanted, ())
    return tuple(
        f"{spoken(where)}: {_shown(there)} there, {_shown(want)} wanted"
        for where, there, want in pairs
    )


def identity(study: ResolvedStudy, seed: int | None) -> dict[str, Any]:
    """Return everything but the participant's number that a session depends on, as plain data."""
    protocol = study.protocol.model_dump(mode="json", by_alias=True)
    del protocol["cohort"]["participants"], protocol["cohort"]["expected_dropout"]
    for field in _ABOUT:
        del protocol[field]
    instruments = [i.model_dump(mode="json", by_alias=True) for i in study.instruments]
    for data, kind in list(_with_later_fields(protocol, instruments)):
        _leave_out_defaults(data, kind)
    for model in protocol.get("models", {}).values():
        if model["sha256"] is not None:  # the model itself, wherever it lies
            del model["path"]
    content = {
        "seed": seed,
        "protocol": protocol,
        "course": study.course.model_dump(mode="json", by_alias=True),
        "instruments": instruments,
    }
    if study.group_courses:
        content["group_courses"] = {
            name: course.model_dump(mode="json", by_alias=True)
            for name, course in study.group_courses.items()
        }
    return content


def _with_later_fields(
    protocol: dict[str, Any], instruments: list[dict[str, Any]]
) -> Iterator[tuple[dict[str, Any], str]]:
    """Yield each part of a study that has got fields later, with its kind; from the inside out."""
    yield protocol["exclusion"], "exclusion"
    if protocol["consent"] is not None:
        yield protocol["consent"], "consent"
    yield protocol["laser"], "laser"
    yield protocol["model"]["parameters"], "parameters"
    for group in protocol["groups"].values():
        if group["model"] is not None:
            yield group["model"]["parameters"], "parameters"
        yield group, "group"
    for condition in protocol["conditions"].values():
        if condition["limitation"] is not None:
            yield condition["limitation"], "limitation"
        yield condition, "condition"
    yield from ((lap, "lap") for lap in protocol["laps"])
    yield from ((analysis, "analysis") for analysis in protocol["analyses"])
    yield protocol["live"], "live"
    yield protocol, "protocol"
    for instrument in instruments:
        yield from ((item, "item") for item in instrument["items"])
        yield instrument, "instrument"


def _leave_out_defaults(data: dict[str, Any], kind: str) -> None:
    for name, default in _LATER[kind].items():
        if data.get(name) == default:
            del data[name]


def _unequal(there: Any, wanted: Any, where: Location) -> Iterator[tuple[Location, Any, Any]]:
    if isinstance(there, dict) and isinstance(wanted, dict):
        for key in dict.fromkeys((*there, *wanted)):
            yield from _unequal(there.get(key, _ABSENT), wanted.get(key, _ABSENT), (*where, key))
    elif isinstance(there, list) and isinstance(wanted, list) and len(there) == len(wanted):
        for i, (left, right) in enumerate(zip(there, wanted, strict=True)):
            yield from _unequal(left, right, (*where, i))
    elif there != wanted:
        yield where, there, wanted


def _shown(value: Any) -> str:
    if value is _ABSENT:
        return "nothing"
    if isinstance(value, list):
        return f"{len(value)} entries"
    if isinstance(value, dict):
        return "a mapping"
    text = repr(value)
    return text if len(text) <= 60 else f"{text[:57]}..."
