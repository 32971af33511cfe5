"""Streams and processes that the model's tests share."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from lad.hyperparameters import GPHyperparameters

VECTORS = Path(__file__).resolve().parents[1] / "data" / "conformance"
LENGTHSCALES = [0.1] * 2 + [1.0] * 2 + [2.0] * 15

Floats = NDArray[np.float64]


def wheelchair_stream(seed: int, steps: int, noise: float) -> tuple[Floats, Floats]:
    """Make inputs (steps, 19) and commands (steps, 2) of a slow course; lidar noise in m."""
    rng = np.random.default_rng(seed)
    t = np.arange(steps)[:, None] * 0.1
    phase = rng.uniform(0.0, 2.0 * np.pi, 19)
    rate = rng.uniform(0.1, 0.6, 19)
    x = np.sin(rate * t + phase)
    x[:, :2] *= 0.3
    x[:, 2:4] *= 0.5
    x[:, 4:] = 2.0 + 1.5 * x[:, 4:] + noise * rng.standard_normal((steps, 15))
    y = np.column_stack([0.35 + 0.3 * np.tanh(x[:, 4] - 2.0), -0.5 * np.cos(x[:, 10])])
    return x, y + 0.02 * rng.standard_normal(y.shape)


def hyperparameters(**changed: object) -> GPHyperparameters:
    """Table I's regressor, with changes."""
    values: dict[str, object] = {"lengthscales": LENGTHSCALES, "noise_variance": 0.01}
    return GPHyperparameters(**(values | changed))


@pytest.fixture(name="stream")
def _stream() -> Callable[[int, int, float], tuple[Floats, Floats]]:
    return wheelchair_stream


@pytest.fixture(name="make_hyperparameters")
def _make_hyperparameters() -> Callable[..., GPHyperparameters]:
    return hyperparameters


@pytest.fixture(name="vectors", scope="session")
def _vectors() -> Path:
    return VECTORS
