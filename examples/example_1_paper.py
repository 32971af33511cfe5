"""
The paper in ten minutes
========================

For people who know Soh & Demiris (2013), or want to. Synthetic people drive the paper's four
laps, and lap times stand beside the paper's. The whole comparison, experiment by experiment, is
``lad-study reproduce``.
"""

import os
import subprocess
import sys
import tempfile
from pathlib import Path

import matplotlib.pyplot as plt

from analysis.frames import study_frames
from analysis.paper import PAPER
from analysis.stats.signed_rank import signed_rank
from protocols.record.reader import open_study

quick = bool(os.environ.get("LAD_STUDY_QUICK"))
work = tempfile.TemporaryDirectory()  # take a folder of your own to keep what is made
folder = Path(work.name)


def lad_study(*arguments: object) -> None:
    """Run a command as at a prompt, and show what it prints."""
    command = [Path(sys.executable).with_name("lad-study"), *map(str, arguments)]
    done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=folder)
    print("$ lad-study", *arguments)
    print(done.stdout)
    if done.returncode:
        raise SystemExit(done.stderr)


# %%
# Run the study
# -------------
#
# Twelve people, as in the paper. The same seed gives the same bytes, so your numbers are these.
# The report is one page that loads nothing from elsewhere: tests with their assumptions,
# questionnaires, maps of assistance, model quality, methods.

how = ["--participants", 2, "--no-report"] if quick else ["--participants", 12]
lad_study("run", "four-lap", *how, "--out", "study")

# %%
# Lap times
# ---------
#
# Each person's four laps are a line; the paper's means are crosses. Baseline and limited laps were
# calibrated on the paper's; the two with help are predictions.

study = open_study(folder / "study")
laps = study_frames(study).laps
times = laps.pivot_table(index="participant", columns="condition", values="lap_time_s")
conditions = ["baseline", "limited", "human-assisted", "model-assisted"]
paper = [
    PAPER[f"people/{c}/mean"].value for c in ("baseline", "limited", "demonstrator", "model-1")
]

figure, axes = plt.subplots(figsize=(7, 4), layout="constrained")
axes.plot(conditions, times[conditions].T, color="0.7", linewidth=1)
axes.plot(conditions, times[conditions].mean(), "o-", color="C0", label="mean")
axes.plot(conditions, paper, "x", color="C3", markersize=10, label="paper")
axes.set(ylabel="lap time / s", ylim=(0, None))
axes.legend(frameon=False)
print(times[conditions].describe().loc[["count", "mean", "std"]].round(1))

# %%
# Does the model help?
# --------------------

result = signed_rank(times["model-assisted"] - times["limited"])
print(f"{result.estimate:.1f} s ({result.low:.1f} to {result.high:.1f}), p = {result.p:.3g}")

# %%
# When did it help?
# -----------------
#
# The model's probability that help is wanted, in the lap that it assists, beside the demonstrator's
# signal, which the model did not see in this lap.

last = int(laps.loc[laps.condition == "model-assisted", "lap"].iloc[0])
steps = study.steps("P0001", last, ["t_s", "p_help", "h_would"]).to_pandas()
figure, axes = plt.subplots(figsize=(7, 3), layout="constrained")
axes.fill_between(steps.t_s, (steps.h_would == 1), step="post", color="0.85", label="demonstrator")
axes.plot(steps.t_s, steps.p_help, label="p(h)")
axes.axhline(0.5, color="0.5", linewidth=0.8)
axes.set(xlabel="time / s", ylabel="p(h)", ylim=(0, 1), title="P0001, the model's lap")
axes.legend(frameon=False)
