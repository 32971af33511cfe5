"""Teach a model a lap of which it is not told when help was given."""

from typing import Protocol

import numpy as np
import pyarrow as pa

from lad.assistant import Assistant, Learner
from lad.command import Command
from lad.inputs import INPUT_NAMES
from lad.latent import LEAST_STEPS, infer_help
from protocols.condition import LatentHelp
from protocols.record.steps import STEP_SCHEMA

COLUMN = "h_inferred"


class Taught(Assistant, Learner, Protocol):
    """An assistant that learns."""


def teach_inferred(
    model: Taught, steps: pa.Table, settings: LatentHelp, rng: np.random.Generator
) -> pa.Table:
    """Infer when help was given in a lap, teach the model that, and return the steps with it.

    The model knows its own inputs and, up to an error, the command that counted. Where the
    inferred p(h = +1) is at least a half it learns that command as help, elsewhere no help. It
    looks at the lap a second time for that, so to the model it is two laps.

    Parameters
    ----------
    model
        Learns; its next lap has not started.
    steps
        The lap as recorded.
    settings
        How well the command that counted is known.
    rng
        For its error.

    Returns
    -------
    Table
        The steps with the column ``h_inferred``; of a lap of fewer than 20 steps, in which nothing
        can be inferred, the steps as they were, and the model has learnt nothing.
    """
    if len(steps) < LEAST_STEPS:
        return steps
    inputs = np.column_stack([steps[name].to_numpy() for name in INPUT_NAMES])
    counted = np.column_stack([steps[f"arbitrated_{c}"].to_numpy() for c in "vw"])
    if settings.command_noise:
        counted = counted + settings.command_noise * rng.normal(size=counted.shape)
    p_help = infer_help(counted - inputs[:, :2]).p_help
    model.start_lap()
    for x, p, (v, w) in zip(np.ascontiguousarray(inputs), p_help, counted.tolist(), strict=True):
        model.assist(x)
        model.learn(bool(p >= 0.5), Command(v, w) if p >= 0.5 else None)
    place = STEP_SCHEMA.get_field_index(COLUMN)
    return steps.set_column(place, STEP_SCHEMA.field(place), pa.array(p_help))
