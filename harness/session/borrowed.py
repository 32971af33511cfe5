"""Models that somebody else than the participant has taught."""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np

from harness.session.latent_teaching import Taught
from harness.session.model import make_model
from harness.session.parts import NO_SEATS, Seats, SessionParts, make_parts, session_model
from harness.session.session import Session
from harness.session.study_run import StudyRun, of_one
from harness.world.world import World
from lad.assistant import Assistant, Learner
from lad.command import Command
from lad.errors import ModelFileError
from lad.inputs import INPUT_NAMES
from lad.lad_assistant import LADAssistant
from lad.trained import from_bytes
from protocols.files.errors import InputError
from protocols.model_choice import BorrowedModel
from protocols.orders import Orders
from protocols.record.identity import study_digest
from protocols.record.reader import Study, open_study
from protocols.record.rows import participant_id

PILOT = 0
"""Number of the synthetic person who teaches the pilot's model: participants count from 1."""

_TAUGHT: dict[tuple[str, int, str], bytes] = {}
"""Models this process has taught, so that it teaches each only once."""


def borrowed_models(run: StudyRun, number: int, world: World) -> dict[str, Assistant]:
    """Return the models that others have taught, by the name the protocol gives them.

    Parameters
    ----------
    run, number
        The study and the participant, counted from 1.
    world
        Of the study's course; the pilot drives in it.

    Raises
    ------
    InputError
        When a file or another study cannot be used.
    """
    return {
        name: _taught_own_laps(run, number, source)
        if source.source == "own laps"
        else _restored(_bytes_of(run, number, name, source, world), name)
        for name, source in run.study.protocol.models.items()
    }


def make_all_parts(
    run: StudyRun, number: int, world: World, seats: Seats = NO_SEATS
) -> SessionParts:
    """Return what takes part in a participant's session, borrowed models included.

    Parameters and exceptions are those of ``make_parts`` and ``borrowed_models``.
    """
    parts = make_parts(run, number, seats=seats)
    return replace(parts, models=borrowed_models(run, number, world))


def _bytes_of(run: StudyRun, number: int, name: str, source: BorrowedModel, world: World) -> bytes:
    if source.source == "file":
        return model_file(source, run.study.folder, number)
    if source.source == "previous participant" and run.previous is not None:
        return run.previous
    what = "pilot" if source.source != "pooled" else name
    key = (run.digest or study_digest(run.study, run.seed), run.seed, what)
    if key not in _TAUGHT:
        taught = _pooled(run, source) if what != "pilot" else _pilot(run, world)
        _TAUGHT[key] = taught
    return _TAUGHT[key]


def model_file(source: BorrowedModel, folder: Path | None, number: int) -> bytes:
    """Return the content of the model file that a participant borrows.

    Raises
    ------
    InputError
        When it cannot be read.
    """
    name = (source.path or "").replace("{participant}", participant_id(number))
    path = (folder or Path()) / name
    try:
        return path.read_bytes()
    except OSError as error:
        raise InputError(f"{path}: no model to borrow: {error.strerror}") from None


def _restored(data: bytes, name: str) -> Assistant:
    try:
        return from_bytes(data, f"model {name!r}")
    except ModelFileError as error:
        raise InputError(str(error)) from None


def _pilot(run: StudyRun, world: World) -> bytes:
    """Let a person who is no participant drive the training laps, and return what was learnt."""
    protocol = run.study.protocol
    training = [lap for lap in protocol.laps if protocol.conditions[lap.condition].training]
    alone: Mapping[str, object] = {
        "laps": tuple(lap.model_copy(update={"survey": (), "break_s": 0.0}) for lap in training),
        "orders": Orders(),
        "groups": {},
        "models": {},
        "survey": (),
        "consent": None,
        "demographics": (),
        "debrief": None,
    }
    study = replace(run.study, protocol=protocol.model_copy(update=alone))
    pilot = replace(run, study=study)
    record = Session(pilot, PILOT, world, make_parts(pilot, PILOT)).run()
    if record.model is None:
        raise InputError("the pilot's model cannot be saved; borrowed models are lad's")
    return record.model


def _pooled(run: StudyRun, source: BorrowedModel) -> bytes:
    """Teach a fresh model every training lap of another study, in the order of its participants."""
    model = make_model(run.study.protocol.model)
    if not isinstance(model, LADAssistant):
        raise InputError("a pooled model is lad's; allowed: model: {use: lad}")
    teach_laps(model, _other_study(run, source))
    return model.to_bytes()


def _taught_own_laps(run: StudyRun, number: int, source: BorrowedModel) -> Assistant:
    """Return the protocol's model after the training laps that a participant had elsewhere.

    It is taught from the record, so it may be any assistant; one that learns nothing is as made.
    """
    model = session_model(of_one(run, number), number)
    if isinstance(model, Learner):
        teach_laps(model, _other_study(run, source), participant_id(number))
    return model


def _other_study(run: StudyRun, source: BorrowedModel) -> Study:
    return open_study((run.study.folder or Path()) / (source.path or ""))


def teach_laps(model: Taught, study: Study, participant: str | None = None) -> None:
    """Teach a study's training laps in the order driven.

    Parameters
    ----------
    model
        Learns.
    study
        As recorded.
    participant
        Whose laps; None for everybody's, one after the other.

    Raises
    ------
    InputError
        When there is no such lap, or inputs or h were not recorded in each step.
    """
    laps = study.laps.to_pandas()
    conditions = study.protocol.conditions
    taught = laps[[c in conditions and conditions[c].training for c in laps["condition"]]]
    if participant is not None:
        taught = taught[taught["participant"] == participant]
    if taught.empty:
        whose = "" if participant is None else f" of {participant}"
        raise InputError(f"{study.folder}: no training lap{whose} in it to teach a model")
    for lap in taught.to_dict("records"):
        corrected = conditions[lap["condition"]].corrections is not None
        _teach(model, study, lap["participant"], int(lap["lap"]), corrected=corrected)


def _teach(model: Taught, study: Study, participant: str, lap: int, *, corrected: bool) -> None:
    """Teach a recorded lap; of one of corrections the steps in which the demonstrator drove."""
    columns = [*INPUT_NAMES, "h", "a_v", "a_w"]
    steps = study.steps(participant, lap, columns).to_pandas().astype("float64")
    inputs = np.ascontiguousarray(steps[list(INPUT_NAMES)].to_numpy())
    if np.isnan(inputs).any() or (steps["h"].isna().any() and not corrected):
        raise InputError(
            f"{study.folder}: {participant}, lap {lap}: inputs or h were not recorded in each step"
        )
    model.start_lap()
    for x, h, v, w in zip(inputs, steps["h"], steps["a_v"], steps["a_w"], strict=True):
        model.assist(x)
        if not np.isnan(h):
            model.learn(h > 0, Command(v, w) if h > 0 else None)
