"""
Your own assistant, checked and benchmarked
===========================================

For people who have a learner of their own. An assistant is a class with ``start_lap``, ``assist``
and, if it learns, ``learn``. This one, in the file ``nearest_five.py``, repeats what was
demonstrated in the five most similar situations:

.. literalinclude:: ../../examples/nearest_five.py
   :language: python
   :lines: 3-

It is put through what a study will ask of it, and then ranked beside the paper's model.
"""

import os
import subprocess
import sys
import tempfile
from pathlib import Path

import matplotlib.pyplot as plt
import pandas as pd

quick = bool(os.environ.get("LAD_STUDY_QUICK"))
work = tempfile.TemporaryDirectory()  # take a folder of your own to keep what is made
here = Path(__file__).parent if "__file__" in globals() else Path.cwd()  # where nearest_five.py is
folder = here


def lad_study(*arguments: object) -> None:
    """Run a command as at a prompt, and show what it prints."""
    command = [Path(sys.executable).with_name("lad-study"), *map(str, arguments)]
    done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=folder)
    print("$ lad-study", *arguments)
    print(done.stdout)
    if done.returncode:
        raise SystemExit(done.stderr)


# %%
# Check it
# --------
#
# Each line says what was found and what is allowed.

lad_study("check-part", "nearest_five:NearestFive")

# %%
# Rank it
# -------
#
# Every assistant meets the same people, noise and demonstrations, and is compared with its own
# demonstrator. The full benchmark has thirteen settings; this is one of them, the paper's. Code of
# your own runs once you allow it with ``--trust``, and after that until its file changes.

if quick:
    how = ["--replicates", 1, "--demonstrations", "1"]
    assistants = ["nearest_five:NearestFive"]
else:
    how = ["--replicates", 6, "--demonstrations", "1,3"]
    assistants = ["nearest_five:NearestFive", "lad", "lad-correction"]
lad_study("benchmark", *assistants, "--setting", "right", *how, "--out", work.name, "--trust")

# %%
# Look at it
# ----------
#
# Lap times after one and after three demonstrations, each minus the demonstrator's own laps. Above
# zero an assistant is slower than who taught it.

laps = pd.read_csv(Path(work.name) / "measures.csv")
found = laps.groupby(["assistant", "demonstrations"]).minus_demonstrator_s.agg(["mean", "std"])
print(found.round(2).to_string())

figure, axes = plt.subplots(figsize=(6.5, 3.2), layout="constrained")
for assistant, rows in found.groupby("assistant"):
    after = rows.index.get_level_values("demonstrations").astype(str)
    axes.errorbar(after, rows["mean"], rows["std"], marker="o", capsize=3, label=assistant)
axes.axhline(0, color="0.5", linewidth=0.8)
axes.set(xlabel="demonstrations", ylabel="behind the demonstrator / s")
axes.legend(frameon=False)
