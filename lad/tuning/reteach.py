"""Teach fresh processes the steps that others were taught."""

from lad.stork_gp import StorkGP
from lad.tuning.taught import TaughtSteps
from lad.window import Window

HELPING, NOT_HELPING = 1.0, -1.0


def reteach(taught: TaughtSteps, when: StorkGP, how: StorkGP, now: Window) -> None:
    """Teach every step again, in order, and stand where the model stands now.

    Parameters
    ----------
    taught
        The steps.
    when, how
        Fresh processes; they may share a window.
    now
        The model's window, at the start of a lap.
    """
    windows = {id(p.window): p.window for p in (when, how)}.values()
    steps = zip(taught.windows, taught.targets, taught.times, taught.laps, strict=True)
    for inputs, target, time, lap in steps:
        for window in windows:
            window.show(inputs, time, lap)
        if target is not None:
            how.learn(target)
        when.learn(NOT_HELPING if target is None else HELPING)
    for window in windows:
        window.start_at(now.time, now.lap)
