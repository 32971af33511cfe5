"""
Sizing and registering a study
==============================

For people who plan a study: how many participants, in which order, and how to show afterwards that
the plan came first.
"""

import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd

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
# The question
# ------------
#
# Does a demonstrator make limited laps faster? Two conditions, in both orders equally often, and
# one confirmatory comparison.

(folder / "plan.yaml").write_text(
    """\
schema: 1
name: does-help-help
title: Does a demonstrator make limited laps faster?
cohort: {participants: 12, respondent: null, expected_dropout: 0.05}
conditions:
  alone: {limitation: {right_turn_rad_s: 0.15}}
  helped: {limitation: {right_turn_rad_s: 0.15}, assistant: demonstrator}
laps: [{condition: alone}, {condition: helped}]
orders: williams
analyses:
  - name: help helps
    condition: helped
    reference: alone
    kind: confirmatory
"""
)
lad_study("validate", "plan.yaml")

# %%
# How many
# --------
#
# A pool of synthetic people is simulated once; a thousand studies of each size are drawn from it
# and tested as declared. The effect that would matter is stated, here 10% less time: the pool
# gives the spread of the differences, and not the effect.

pool, sizes = (8, "2") if quick else (96, "6:24")
lad_study(
    "power", "plan.yaml", "--pool", pool, "--n", sizes, "--assume", "help helps: -10%",
    "--out", "planning", "--json", "power.json",
)  # fmt: skip
rows = pd.DataFrame(json.loads((folder / "power.json").read_text()))
rows["error"] = np.hypot(rows.mc_error, rows.pool_error)
print(rows[["n", "power", "error"]].round(3).to_string(index=False))

figure, axes = plt.subplots(figsize=(6, 3.2), layout="constrained")
axes.errorbar(rows.n, rows.power, 1.96 * rows.error, marker="o")
axes.axhline(0.8, color="0.5", linewidth=0.8)
axes.set(xlabel="participants", ylabel="power", ylim=(0, 1))

# %%
# Register
# --------
#
# The plan is frozen under a digest; orders are drawn from the digest, so the data show that the
# plan came first. ``registration.md`` has the headings of the common registries, and says what
# you still have to write yourself.

people = 1 if quick else 12
lad_study("preregister", "plan.yaml", "--participants", people, "--out", "registration")

# %%
# Carry it out
# ------------
#
# Another plan, or a changed byte, would be refused.

lad_study(
    "run", "plan.yaml", "--participants", people, "--registration", "registration",
    "--out", "study", "--no-report",
)  # fmt: skip
lad_study("check", "study")
