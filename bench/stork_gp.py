# ruff: noqa: E402  # BLAS reads its number of threads when numpy is imported
"""Time the learning step: ``python bench/stork_gp.py [--json FILE] [--plot FILE]``.

With the basis set full at m vectors, 19 inputs and two outputs, on a stream with centimetres of
lidar noise, one thread. Each learning operation is timed with its prediction. Implementations
take turns, so that whatever else the machine does meets them alike; medians are reported.
``dsymv`` and ``dsyr`` of the same size are the reference: one pass over a triangle each.
"""

import os

for name in ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS"):
    os.environ[name] = "1"  # before numpy loads its BLAS

import argparse
import gc
import importlib.util
import json
import math
import platform
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

import matplotlib as mpl

mpl.use("Agg")

from matplotlib import pyplot as plt
from scipy.linalg.blas import dsymv, dsyr
from stork_gp_blas import BlasStorkGP
from stork_gp_refit import flattened, gpytorch_steps, sklearn_steps

from lad.hyperparameters import GPHyperparameters
from lad.plain import PlainStorkGP
from lad.posterior import Posterior
from lad.snapshot import restore_state, state_arrays
from lad.state import State
from lad.stork_gp import StorkGP
from lad.triangle import whole
from lad.update import UpdateKind

SIZES = (100, 200, 400, 800)
DEPTHS = (1, 4, 16)
OPERATIONS = ("predict", "sparse", "full", "full+delete")
MARGIN = 8
ALL_SPARSE = 0.999999
LIDAR_NOISE = 0.02
TRAINING_STEPS = 5_000
TIMED_STEPS = 5_000
KINDS = {
    "sparse": UpdateKind.SPARSE,
    "full": UpdateKind.FULL,
    "full+delete": UpdateKind.FULL_THEN_DELETION,
}

Data = tuple[np.ndarray, np.ndarray]
Peer = Callable[..., dict[str, Callable[[np.ndarray], None]]]
Step = Callable[[], float | None]
"""One timed operation, in seconds; None when the stream brought another kind of step."""


@dataclass(frozen=True)
class Row:
    """One cell of the table."""

    implementation: str
    operation: str
    m: int
    tau: int
    median_us: float


def stream(steps: int) -> Data:
    """Make the inputs and commands of a chair on a slow course, lidar noise of centimetres."""
    rng = np.random.default_rng(0)
    t = 0.1 * np.arange(steps)[:, None]
    x = np.sin(rng.uniform(0.1, 0.6, 19) * t + rng.uniform(0.0, 2.0 * np.pi, 19))
    x[:, :2] *= 0.3
    x[:, 2:4] *= 0.5
    x[:, 4:] = 2.0 + 1.5 * x[:, 4:] + LIDAR_NOISE * rng.standard_normal((steps, 15))
    y = np.column_stack([0.35 + 0.3 * np.tanh(x[:, 4] - 2.0), -0.5 * np.cos(x[:, 10])])
    return x, y + 0.02 * rng.standard_normal(y.shape)


def hyperparameters(m: int, tau: int, novelty: float = 1e-4) -> GPHyperparameters:
    """Table I with another size and depth."""
    return GPHyperparameters(
        lengthscales=[0.1] * 2 + [1.0] * 2 + [2.0] * 15,
        noise_variance=0.01,
        capacity=m,
        recursion_depth=tau,
        novelty=novelty,
    )


def trained(m: int, tau: int, data: Data) -> StorkGP:
    """Train until m basis vectors are there, and a little further if they may be replaced."""
    process = StorkGP(hyperparameters(m, tau), n_outputs=2)
    extra = 0
    for x, y in zip(*(part[:TRAINING_STEPS] for part in data), strict=True):
        process.observe(x)
        process.learn(y)
        extra += process.n_basis == m
        if extra > 20:
            return process
    raise RuntimeError(f"the stream is too short to fill {m} basis vectors")


def make_lad(hyper: GPHyperparameters, state: State, room: int) -> StorkGP:
    """Give the fused form a trained state."""
    del room
    process = StorkGP(hyper, n_outputs=2)
    restore_state(process.state, state_arrays(state))
    return process


def make_plain(hyper: GPHyperparameters, state: State, room: int) -> PlainStorkGP:
    """Give the plain form a trained state."""
    del room
    process, n = PlainStorkGP(hyper, n_outputs=2), state.n
    process.state = Posterior(state.alpha[:, :n].T.copy(), whole(state.C, n), whole(state.Q, n))
    process.basis = np.ascontiguousarray(state.basis[:, :, :n].transpose(2, 0, 1))
    process.times = state.times[:n].copy()
    return process


MAKERS = {"lad": make_lad, "blas": BlasStorkGP, "numpy": make_plain}


def setting(operation: str, m: int, tau: int) -> tuple[GPHyperparameters, int, int]:
    """Hyperparameters, vectors to begin with, and room, for one operation."""
    if operation == "full":
        return hyperparameters(m + MARGIN, tau), m - MARGIN, m + MARGIN
    novelty = ALL_SPARSE if operation == "sparse" else 1e-4
    return hyperparameters(m, tau, novelty), m, m


def online_step(implementation: str, operation: str, m: int, tau: int, data: Data) -> Step:
    """Build the timed operation of one of the three forms of the model."""
    hyper, size, room = setting(operation, m, tau)
    state = trained(size, tau, data).state
    x, y = data
    inputs: Iterator[int] = iter(range(TRAINING_STEPS, len(x)))
    process = MAKERS[implementation](hyper, state, room)
    for _ in range(tau):
        process.observe(x[next(inputs)])

    def step() -> float | None:
        nonlocal process, inputs
        if operation == "full" and _size(process) == m + MARGIN:
            window = process.window
            process = MAKERS[implementation](hyper, state, room)
            process.window = window
        i = next(inputs)
        process.observe(x[i])
        before = time.perf_counter()
        process.predict()
        if operation == "predict":
            return time.perf_counter() - before
        update = process.learn(y[i])
        elapsed = time.perf_counter() - before
        return elapsed if _counts(implementation, operation, update, process, room) else None

    return step


def _size(process: StorkGP | PlainStorkGP | BlasStorkGP) -> int:
    return process.n if isinstance(process, BlasStorkGP) else process.n_basis


def _counts(implementation: str, operation: str, update: object, process: object, m: int) -> bool:
    """Return whether the step was the operation, and not a deletion of the sample just added."""
    if update.kind != KINDS[operation]:
        return False
    if operation != "full+delete":
        return True
    itself = m if implementation == "blas" else process.window.time
    return update.deleted_time != itself


def refit_step(make: Peer, operation: str, m: int, tau: int, data: Data) -> Step | None:
    """Build the timed operation of a peer; None where it has no such operation."""
    process = trained(m, tau, data)
    rows = flattened(process.state.basis, m)
    try:
        steps = make(process.hyperparameters, rows, data[1][:m].copy())
        if operation not in steps:
            return None
        steps[operation](rows[0])
    except Exception as error:  # noqa: BLE001  # a peer's trouble is not ours
        print(f"{make.__name__}, {operation}: failed, left out ({error})")
        return None
    near = iter(np.tile(rows, (50, 1)) + 0.01)

    def step() -> float:
        one = next(near)
        before = time.perf_counter()
        steps[operation](one)
        return time.perf_counter() - before

    return step


def bound_steps(m: int) -> dict[str, Step]:
    """BLAS passes over a triangle: reading, reading and writing, and what a step must do at least.

    ``full+delete`` reads both C and Q to predict and to find what is new, and changes both: two
    ``dsymv`` and two ``dsyr`` in place, of two matrices, which take turns in the cache as C and Q
    do.
    """
    rng = np.random.default_rng(1)
    matrix, written = (np.asfortranarray(rng.normal(size=(m, m))) for _ in range(2))
    C, Q = (np.asfortranarray(rng.normal(size=(m, m))) for _ in range(2))
    vector, out = rng.normal(size=m), np.zeros(m)

    def product() -> float:
        before = time.perf_counter()
        dsymv(1.0, matrix, vector, y=out, overwrite_y=1, lower=1)
        return time.perf_counter() - before

    def update() -> float:
        before = time.perf_counter()
        dsyr(1e-12, vector, lower=1, a=written, overwrite_a=1)
        return time.perf_counter() - before

    def step() -> float:
        before = time.perf_counter()
        dsymv(1.0, C, vector, y=out, overwrite_y=1, lower=1)
        dsymv(1.0, Q, vector, y=out, overwrite_y=1, lower=1)
        dsyr(1e-12, vector, lower=1, a=C, overwrite_a=1)
        dsyr(1e-12, vector, lower=1, a=Q, overwrite_a=1)
        return time.perf_counter() - before

    return {"dsymv": product, "dsyr": update, "full+delete": step}


def measure(steps: dict[str, Step], rounds: int) -> dict[str, float]:
    """Median time of each, in microseconds: they take turns, the fast ones several at a time."""
    samples: dict[str, list[float]] = {name: [] for name in steps}
    turns = {}
    for name, step in steps.items():
        step()
        began = time.perf_counter()
        step()
        turns[name] = int(np.clip(3e-3 / (time.perf_counter() - began), 1, 20))
    gc.collect()
    gc.disable()
    for _ in range(rounds):
        for name, step in steps.items():
            for _ in range(turns[name]):
                elapsed = step()
                if elapsed is not None:
                    samples[name].append(elapsed)
    gc.enable()
    return {name: 1e6 * float(np.median(times)) for name, times in samples.items() if times}


def peers() -> dict[str, Peer]:
    """Return the peers that are installed, and print which are not."""
    found = {}
    for name, module, make in (
        ("sklearn", "sklearn", sklearn_steps),
        ("gpytorch", "gpytorch", gpytorch_steps),
    ):
        if importlib.util.find_spec(module):
            found[name] = make
        else:
            print(f"{name}: not installed, left out")
    return found


def run(rounds: int) -> list[Row]:
    """Measure every cell."""
    data = stream(TRAINING_STEPS + TIMED_STEPS)
    rows = []
    others = peers()
    for tau in DEPTHS:
        for m in SIZES:
            for operation in OPERATIONS:
                steps: dict[str, Step] = {
                    name: online_step(name, operation, m, tau, data) for name in MAKERS
                }
                for name, make in others.items():
                    step = refit_step(make, operation, m, tau, data)
                    if step is not None:
                        steps[name] = step
                bounds = bound_steps(m) if operation == "full+delete" else {}
                for name, median in measure(steps | bounds, rounds).items():
                    bound = name in bounds
                    rows.append(
                        Row(
                            "bound" if bound else name, name if bound else operation, m, tau, median
                        )
                    )
            print(f"tau = {tau}, m = {m}: measured", file=sys.stderr, flush=True)
    return rows


def table(rows: list[Row]) -> str:
    """Format the medians, a table for each tau; in brackets, how many times as long as ``lad``.

    ``bound`` is the other way round: in brackets, how many times its own physical limit ``lad``
    takes.
    """
    found = {(r.implementation, r.operation, r.m, r.tau): r.median_us for r in rows}
    others = [
        name
        for name in ("blas", "numpy", "sklearn", "gpytorch")
        if any(row.implementation == name for row in rows)
    ]
    header = ["m", "operation", "lad", *others, "dsymv", "dsyr", "lad / dsymv", "bound"]
    blocks = []
    for tau in DEPTHS:
        lines = ["| " + " | ".join(header) + " |", "|---:|---|" + "---:|" * (len(header) - 2)]
        for m in SIZES:
            bounds = [found["bound", name, m, tau] for name in ("dsymv", "dsyr")]
            for operation in OPERATIONS:
                own = found["lad", operation, m, tau]
                cells = [str(m), operation, f"{own:.1f}"]
                for name in others:
                    other = found.get((name, operation, m, tau))
                    cells.append("" if other is None else f"{other:.0f} ({other / own:.1f})")
                cells += [f"{bound:.1f}" for bound in bounds]
                least = found.get(("bound", operation, m, tau))
                limit = "" if least is None else f"{least:.0f} ({own / least:.1f})"
                lines.append("| " + " | ".join([*cells, f"{own / bounds[0]:.1f}", limit]) + " |")
        blocks.append(f"**tau = {tau}**\n\n" + "\n".join(lines))
    return "\n\n".join(blocks)


def verdict(rows: list[Row]) -> str:
    """Compare what was aimed for with what was measured."""
    found = {(r.implementation, r.operation, r.m, r.tau): r.median_us for r in rows}
    step = {m: found["lad", "full+delete", m, 4] for m in SIZES}
    in_products = step[400] / found["bound", "dsymv", 400, 4]
    of_blas = step[400] / found["blas", "full+delete", 400, 4]
    growth = math.log(step[800] / step[200]) / math.log(800 / 200)
    limits = [
        (
            f"full+delete at m = {m}, tau = 4, of two dsymv and two dsyr",
            step[m] / found["bound", "full+delete", m, 4],
            1.8,
        )
        for m in (200, 400, 800)
    ]
    lines = [
        *limits,
        ("full+delete at m = 400, tau = 4, in dsymv", in_products, 9.0),
        ("full+delete at m = 400, tau = 4, of blas", of_blas, 0.6),
        ("exponent of growth from m = 200 to 800, tau = 4", growth, 2.0),
    ]
    return "\n".join(
        f"{what}: {value:.2f} (at most {most:g}): {'met' if value <= most else 'MISSED'}"
        for what, value, most in lines
    )


def plot(rows: list[Row], path: Path) -> None:
    """Draw time against size for the step that matters, one line per implementation."""
    figure, axes = plt.subplots(figsize=(6.0, 4.2), layout="constrained")
    for name, operation in [
        *((n, "full+delete") for n in ("sklearn", "numpy", "blas", "lad")),
        ("bound", "dsymv"),
    ]:
        cells = sorted(
            (r.m, r.median_us)
            for r in rows
            if (r.implementation, r.operation, r.tau) == (name, operation, 4)
        )
        if cells:
            label = "dsymv (bound)" if name == "bound" else name
            style = "k:" if name == "bound" else "o-"
            axes.loglog(*zip(*cells, strict=True), style, label=label)
    axes.set_xticks(SIZES, [str(m) for m in SIZES])
    axes.minorticks_off()
    axes.set_xlabel("basis vectors m")
    axes.set_ylabel("microseconds per step")
    axes.set_title("Prediction, full update and deletion, tau = 4, d = 19, two outputs")
    axes.grid(alpha=0.3)
    axes.legend()
    figure.savefig(path, metadata={"Date": None} if path.suffix == ".svg" else None)
    plt.close(figure)


def processor() -> str:
    """Name the processor as far as the system tells."""
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        return platform.processor() or platform.machine()
    models = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    return models[0] if models else platform.machine()


def main(arguments: list[str] | None = None) -> int:
    """Measure, print the table and the promises, write the plot and the rows."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the rows here")
    parser.add_argument("--plot", type=Path, metavar="FILE", default=Path("stork_gp.svg"))
    parser.add_argument("--rounds", type=int, default=15, help="turns of each implementation")
    options = parser.parse_args(arguments)
    rows = run(options.rounds)
    print(f"{processor()}, numpy {np.__version__}, Python {platform.python_version()}, one thread")
    print("Median microseconds per operation; learning operations include their prediction.\n")
    print(table(rows))
    print()
    print(verdict(rows))
    plot(rows, options.plot)
    if options.json:
        options.json.write_text(json.dumps([asdict(row) for row in rows], indent=1) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
