"""Compile everything now, so that no lap has to wait for it."""

import numpy as np

from lad.command import Command
from lad.hyperparameters import LADParameters
from lad.inputs import N_INPUTS
from lad.lad_assistant import LADAssistant


def warm_up() -> None:
    """Run every compiled function once.

    The first step ever taken on a machine compiles for some seconds, and so does the first repair;
    after that the machine code is read from numba's cache in a few tenths of a second, once per
    process. Call this before a person sits in the chair.
    """
    model = LADAssistant(LADParameters(capacity=2))
    model.start_lap()
    for step in range(4):
        model.how.health.risk = 1.0
        model.assist(np.full(N_INPUTS, float(step)))
        model.learn(helping=True, command=Command(0.1, -0.1))
    for process in (model.when, model.how):
        process.repair()
