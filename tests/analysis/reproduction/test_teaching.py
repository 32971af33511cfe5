"""Teaching: every step is predicted before it is learnt, and the last lap never is."""

from functools import partial

import numpy as np
import pytest

from analysis.reproduction.demonstrations import Demonstration
from analysis.reproduction.teaching import permutations, teach, teach_in_orders
from lad.assistant import Assistance
from lad.command import Command
from lad.lad_assistant import LADAssistant


def demonstration(number, steps=4):
    """Return a lap whose inputs say which lap and step they belong to."""
    x = np.zeros((steps, 19))
    x[:, 0], x[:, 1] = number, np.arange(steps)
    helped = np.arange(steps) % 2 == 1
    action = np.where(helped[:, None], [[0.2, -0.5]], np.nan)
    return Demonstration(t=np.arange(steps) * 0.1, x=x, helped=helped, action=action)


class Parrot:
    """Knows what it has learnt by heart: p(h) is 1 for a step learnt with help, 0 without."""

    def __init__(self):
        self.known, self.seen, self.log = {}, None, []

    def start_lap(self):
        self.seen = None
        self.log.append("lap")

    def assist(self, x):
        self.seen = tuple(x)
        self.log.append(("assist", x[0], x[1]))
        return Assistance(False, p_help=self.known.get(self.seen, 0.5), mean=Command(0, 0),
                          variance=1.0)  # fmt: skip

    def learn(self, helping, command):
        self.log.append(("learn", self.seen[0], self.seen[1], helping, command))
        self.known[self.seen] = float(helping)


def test_no_step_is_predicted_after_it_was_learnt():
    """A model that knows by heart what it learnt knows nothing of what it predicts."""
    run = teach(Parrot, [demonstration(i) for i in range(3)], (2, 0, 1))
    assert all((lap.p_help == 0.5).all() for lap in run)


def test_laps_come_in_the_order_given_and_the_last_is_not_learnt():
    """start_lap, then assist and learn by turns; in the last lap assist only."""
    model = Parrot()
    run = teach(lambda: model, [demonstration(i, steps=2) for i in range(3)], (2, 0, 1))
    assert [lap.lap for lap in run] == [2, 0, 1]
    help_ = Command(0.2, -0.5)
    taught = [
        entry
        for lap in (2, 0)
        for entry in (
            "lap",
            ("assist", lap, 0), ("learn", lap, 0, False, None),
            ("assist", lap, 1), ("learn", lap, 1, True, help_),
        )
    ]  # fmt: skip
    assert model.log == [*taught, "lap", ("assist", 1, 0), ("assist", 1, 1)]


def test_a_lap_that_comes_twice_is_known_the_second_time():
    """The check above can fail: what was learnt shows."""
    run = teach(Parrot, [demonstration(0)], (0, 0))
    assert run[1].p_help.tolist() == run[1].helped.astype(float).tolist()


def test_an_assistant_without_probabilities_says_nothing():
    """What is not predicted is NaN."""

    class Silent(Parrot):
        def assist(self, x):
            super().assist(x)
            return Assistance(helping=False)

    (lap,) = teach(Silent, [demonstration(0)], (0,))
    assert np.isnan(lap.p_help).all()
    assert np.isnan(lap.mean).all()


def test_processes_change_nothing():
    """Taught here or in two processes, models predict the same bits; progress is told."""
    laps, orders, told = [demonstration(i, steps=6) for i in range(2)], ((0, 1), (1, 0)), []
    make = partial(LADAssistant, None)
    here = teach_in_orders(make, laps, orders, 1)
    there = teach_in_orders(make, laps, orders, 2, lambda *of: told.append(of))
    assert told == [(1, 2), (2, 2)]
    for one, other in zip(here, there, strict=True):
        for a, b in zip(one, other, strict=True):
            np.testing.assert_array_equal(a.p_help, b.p_help)
            np.testing.assert_array_equal(a.mean, b.mean)


@pytest.mark.parametrize("n", [1, 10])
def test_permutations_come_from_the_generator(n):
    """The same generator gives the same orders, each of all demonstrations."""
    first, again = (permutations(n, 15, np.random.default_rng(3)) for _ in range(2))
    assert first == again
    assert len(first) == 15
    assert all(sorted(order) == list(range(n)) for order in first)
