"""Smallest and largest value, mean and spread of what is seen part by part."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray


@dataclass
class Moments:
    """Smallest, largest, sum and sum of squares of a feature, added up lap by lap."""

    count: int = 0
    low: NDArray[np.float64] | None = None
    high: NDArray[np.float64] | None = None
    mean: NDArray[np.float64] | None = None
    square: NDArray[np.float64] | None = None  # sum of squared distances from the mean

    def add(self, values: NDArray[np.float64]) -> None:
        """Add one lap: shape (frames, numbers)."""
        low, high, mean = values.min(axis=0), values.max(axis=0), values.mean(axis=0)
        square = ((values - mean) ** 2).sum(axis=0)
        if self.mean is None or self.low is None or self.high is None or self.square is None:
            self.count, self.low, self.high = len(values), low, high
            self.mean, self.square = mean, square
            return
        total = self.count + len(values)
        apart = mean - self.mean
        self.low, self.high = np.minimum(self.low, low), np.maximum(self.high, high)
        self.square = self.square + square + apart**2 * (self.count * len(values) / total)
        self.mean = self.mean + apart * (len(values) / total)
        self.count = total

    def as_stats(self) -> dict[str, list[Any]]:
        """Return them as the format has them."""
        if self.mean is None or self.low is None or self.high is None or self.square is None:
            return {}
        std = np.sqrt(self.square / self.count)
        parts = {"min": self.low, "max": self.high, "mean": self.mean, "std": std}
        return {name: part.tolist() for name, part in parts.items()} | {"count": [self.count]}
