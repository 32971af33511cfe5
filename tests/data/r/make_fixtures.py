"""Draw the data that both R and our tests read. Run once; the CSV files are committed."""

from pathlib import Path

import numpy as np
import pandas as pd

HERE = Path(__file__).parent
rng = np.random.default_rng(20140901)

pace = rng.lognormal(3.9, 0.3, 12)
factors = {"baseline": 1.0, "limited": 1.55, "human": 0.95, "model": 1.15}
laps = pd.DataFrame(
    [
        {
            "participant": f"P{i:02d}",
            "condition": condition,
            "lap": lap,
            "lap_time_s": pace[i] * factor * rng.lognormal(0, 0.12),
        }
        for i in range(12)
        for lap, (condition, factor) in enumerate(factors.items(), start=1)
    ]
)
laps.round(4).to_csv(HERE / "laps.csv", index=False)

# The same with the order turned round for every other participant, and two laps missing.
turned = laps.assign(
    lap=[
        5 - lap if int(p[1:]) % 2 else lap
        for p, lap in zip(laps["participant"], laps["lap"], strict=True)
    ]
)
turned.drop([5, 30]).round(4).to_csv(HERE / "laps_turned.csv", index=False)

latent = rng.normal(0, 1.2, 24)[:, None] + rng.normal(0, 1, (24, 2)) + [0.0, 0.7]
answers = 1 + np.digitize(latent, [-1.5, -0.5, 0.3, 1.4])
pd.DataFrame(answers, columns=["reference", "condition"]).to_csv(HERE / "item.csv", index=False)

trait = rng.normal(0, 1, 15)[:, None] + rng.normal(0, 0.9, (15, 4))
scale = 1 + np.digitize(trait, [-1.5, -0.5, 0.5, 1.5])
pd.DataFrame(scale, columns=["a", "b", "c", "d"]).to_csv(HERE / "scale.csv", index=False)
