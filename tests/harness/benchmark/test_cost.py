"""What a look costs: every assistant gets the same inputs, in turns, and learns nothing."""

import numpy as np

from harness.benchmark.cost import BLOCK, PASSES, costs_of
from lad.assistant import NO_ASSISTANCE


class Counting:
    """An assistant that remembers what it saw."""

    def __init__(self, order, name):
        self.order, self.name, self.seen, self.laps = order, name, [], 0

    def start_lap(self):
        """Count."""
        self.laps += 1

    def assist(self, x):
        """Remember."""
        self.seen.append(x[0])
        if not self.order or self.order[-1] != self.name:
            self.order.append(self.name)
        return NO_ASSISTANCE


def test_assistants_take_turns_on_the_same_steps():
    """Whole blocks alternate; what does not fill a block is left out for all."""
    order = []
    models = {name: Counting(order, name) for name in ("one", "other")}
    rows = np.arange(2 * BLOCK + 7, dtype=float)[:, None] * np.ones(19)
    found = costs_of(models, rows)
    assert list(found) == ["one", "other"]
    assert all(value >= 0 for value in found.values())
    assert order == ["one", "other"] * (2 * PASSES)
    assert models["one"].seen == models["other"].seen == list(range(2 * BLOCK)) * PASSES
    assert models["one"].laps == PASSES
