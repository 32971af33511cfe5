"""Teach a model demonstrations in some order, and keep what it predicted before learning each step.

The online regime of section IV.D: the model learned "in an online fashion, i.e., trained/tested at
each time step during nine laps. The final tenth lap was used for testing".
"""

import signal
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass
from functools import partial
from multiprocessing import get_context
from pkgutil import resolve_name
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from analysis.reproduction.demonstrations import Demonstration
from lad.assistant import Assistant, Learner
from lad.command import Command
from protocols.model_choice import ModelChoice
from protocols.shipped_parts import WITH_PARAMETERS, shipped_factory


class LearningAssistant(Assistant, Learner, Protocol):
    """An assistant that learns."""


MakeModel = Callable[[], LearningAssistant]
"""Makes a fresh model; importable in another process."""


def maker(choice: ModelChoice) -> MakeModel:
    """Return what makes a fresh model as a protocol names it."""
    make = resolve_name(shipped_factory("model", choice.use) or choice.use)
    if choice.use in WITH_PARAMETERS:
        return partial(make, choice.parameters)
    return partial(make, **choice.options)


@dataclass(frozen=True, slots=True)
class PredictedLap:
    """One demonstration with the predictions of a model that had not learnt the step yet.

    Attributes
    ----------
    lap
        Which demonstration, counted from 0.
    t, helped, action
        As in the demonstration.
    p_help
        Shape (steps,): p(h = 1 | x).
    mean
        Shape (steps, 2): predicted assistive command, m/s and rad/s.
    variance
        Shape (steps,): its predictive variance, the same for both components.
    """

    lap: int
    t: NDArray[np.float64]
    helped: NDArray[np.bool_]
    action: NDArray[np.float64]
    p_help: NDArray[np.float64]
    mean: NDArray[np.float64]
    variance: NDArray[np.float64]


Run = tuple[PredictedLap, ...]
"""All demonstrations in the order they were taught; the last one was only predicted."""


def teach(make_model: MakeModel, laps: Sequence[Demonstration], order: Sequence[int]) -> Run:
    """Teach a fresh model the demonstrations in an order; the last one only tests it."""
    model = make_model()
    last = len(order) - 1
    return tuple(
        _lap(model, laps[i], i, learning=position < last) for position, i in enumerate(order)
    )


def teach_in_orders(
    make_model: MakeModel,
    laps: Sequence[Demonstration],
    orders: Sequence[Sequence[int]],
    jobs: int,
    tell: Callable[[int, int], None] | None = None,
) -> tuple[Run, ...]:
    """Teach one fresh model per order, in parallel processes.

    Parameters
    ----------
    make_model
        Makes a fresh model; importable in another process unless ``jobs`` is 1.
    laps
        The demonstrations.
    orders
        For each model, which demonstrations it is taught, by their place in ``laps``.
    jobs
        Number of processes, 1 or more.
    tell
        Called with how many models have been taught, and of how many.

    Raises
    ------
    OSError
        When a process was killed.
    """
    task = partial(teach, make_model, laps)
    if jobs == 1:
        return _counted(map(task, orders), len(orders), tell)
    # Spawned, because forking a process that has threads is not safe.
    context = get_context("spawn")
    try:
        with ProcessPoolExecutor(min(jobs, len(orders)), context, _leave_interrupts) as pool:
            return _counted(pool.map(task, orders), len(orders), tell)
    except BrokenProcessPool:
        raise OSError("a process in which a model was being taught was killed") from None


def permutations(n: int, count: int, rng: np.random.Generator) -> tuple[tuple[int, ...], ...]:
    """Return random orders of n demonstrations.

    Examples
    --------
    >>> [sorted(order) for order in permutations(3, 2, np.random.default_rng(0))]
    [[0, 1, 2], [0, 1, 2]]
    """
    return tuple(tuple(int(i) for i in rng.permutation(n)) for _ in range(count))


def _counted(
    runs: Iterable[Run], planned: int, tell: Callable[[int, int], None] | None
) -> tuple[Run, ...]:
    taught: list[Run] = []
    for run in runs:
        taught.append(run)
        if tell:
            tell(len(taught), planned)
    return tuple(taught)


def _leave_interrupts() -> None:
    """Ignore Ctrl-C here: the process that started this one handles it and ends the pool."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)


def _lap(
    model: LearningAssistant, lap: Demonstration, index: int, *, learning: bool
) -> PredictedLap:
    model.start_lap()
    answers = np.full((len(lap.t), 4), np.nan)
    for step, x in enumerate(lap.x):
        answer = model.assist(x)
        mean = answer.mean or (np.nan, np.nan)
        answers[step] = (_number(answer.p_help), *mean, _number(answer.variance))
        if learning:
            helped = bool(lap.helped[step])
            model.learn(helped, Command(*lap.action[step].tolist()) if helped else None)
    return PredictedLap(
        lap=index,
        t=lap.t,
        helped=lap.helped,
        action=lap.action,
        p_help=answers[:, 0],
        mean=answers[:, 1:3],
        variance=answers[:, 3],
    )


def _number(value: float | None) -> float:
    return np.nan if value is None else value
