"""What a step of an assistant costs beside Table I's, interleaved in one run, in CPU time.

    python bench/assistant_cost.py [--rounds 40]

Both are taught until their basis sets are full; then blocks of steps alternate, looking and
learning with help in every second step, and the median of the blocks' times is printed.
"""

import argparse
import time
from collections.abc import Callable

import numpy as np

from lad.command import Command
from lad.correction import CorrectionAssistant
from lad.lad_assistant import LADAssistant

FILL = 1000
BLOCK = 50


def inputs(rng: np.random.Generator, steps: int) -> np.ndarray:
    """Return inputs of a slow course with a centimetre of lidar noise, shape (steps, 19)."""
    t = np.arange(steps)[:, None] * 0.1
    x = np.sin(rng.uniform(0.1, 0.6, 19) * t + rng.uniform(0, 2 * np.pi, 19))
    x[:, :2] *= 0.3
    x[:, 2:4] *= 0.5
    x[:, 4:] = 2.0 + 1.5 * x[:, 4:] + 0.01 * rng.standard_normal((steps, 15))
    return x


def block(model: LADAssistant, rows: np.ndarray) -> float:
    """Return the CPU time of a step, in microseconds."""
    begun = time.process_time()
    for i, x in enumerate(rows):
        model.assist(x)
        model.learn(helping=i % 2 == 0, command=Command(0.3, -0.4) if i % 2 == 0 else None)
    return 1e6 * (time.process_time() - begun) / len(rows)


def medians(
    makers: dict[str, Callable[[], LADAssistant]], rounds: int
) -> dict[str, tuple[float, int]]:
    """Return each assistant's median time of a step, microseconds, and its basis vectors."""
    models = {name: make() for name, make in makers.items()}
    rows = inputs(np.random.default_rng(0), FILL + rounds * BLOCK)
    times: dict[str, list[float]] = {name: [] for name in models}
    for model in models.values():
        model.start_lap()
        block(model, rows[:FILL])
    for r in range(rounds):
        part = rows[FILL + r * BLOCK : FILL + (r + 1) * BLOCK]
        order = list(models.items())[:: 1 if r % 2 else -1]
        for name, model in order:
            times[name].append(block(model, part))
    return {n: (float(np.median(t)), models[n].how.n_basis) for n, t in times.items()}


def main() -> None:
    """Print a table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=40)
    found = medians(
        {"lad": LADAssistant, "lad-correction": CorrectionAssistant}, parser.parse_args().rounds
    )
    table_i = found["lad"][0]
    for name, (microseconds, basis) in found.items():
        print(f"{name:15} {microseconds:7.1f} us  {microseconds / table_i:.3f}  {basis} vectors")


if __name__ == "__main__":
    main()
