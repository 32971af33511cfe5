"""Draw the data of mixed_model.R: missing laps in a Williams square, and groups. Run once."""

from pathlib import Path

import numpy as np
import pandas as pd

HERE = Path(__file__).parent
rng = np.random.default_rng(20261127)
SQUARE = [[0, 1, 3, 2], [1, 2, 0, 3], [2, 3, 1, 0], [3, 0, 2, 1]]
CONDITIONS = ["baseline", "limited", "human", "model"]
EFFECT = [0.0, 0.4, -0.05, 0.12]
PRACTICE = [0.0, -0.08, -0.12, -0.14]


def square(people: int, missing: list[int]) -> pd.DataFrame:
    """Return lap times of people in a Williams square, some laps missing."""
    rows = []
    for i in range(people):
        own = rng.normal(4, 0.25)
        for place, c in enumerate(SQUARE[i % 4], start=1):
            time = np.exp(own + EFFECT[c] + PRACTICE[place - 1] + rng.normal(0, 0.1))
            rows.append((f"P{i:02d}", "ab"[i // 4 % 2], CONDITIONS[c], place, time))
    names = ["participant", "group", "condition", "place", "lap_time_s"]
    return pd.DataFrame(rows, columns=names).drop(missing)


square(12, [3, 5, 17, 22, 30, 31, 40]).round(4).to_csv(HERE / "laps_square.csv", index=False)
square(16, [2, 9, 33, 34, 50]).round(4).to_csv(HERE / "laps_groups.csv", index=False)

# Two groups of three people with ten laps each: 60 laps, and yet only six people.
many = [
    (f"P{i}", "ab"[i % 2], np.exp(rng.normal(0, 0.1) + own))
    for i, own in enumerate(rng.normal(4, 0.2, 6) + np.array([0.0, 0.3] * 3))
    for _ in range(10)
]
frame = pd.DataFrame(many, columns=["participant", "group", "lap_time_s"])
frame.round(4).to_csv(HERE / "laps_six_people.csv", index=False)
