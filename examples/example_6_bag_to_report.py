"""
From a wheelchair's recording to a report
=========================================

For people who have a real wheelchair, or its recordings. ROS 1 bags, ROS 2 recordings and MCAP
files become a study; ROS is not needed.
"""

import os
import subprocess
import sys
import tempfile
from pathlib import Path

import matplotlib.pyplot as plt

from analysis.figures.plan import draw_plan
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
# A recording
# -----------
#
# Where you would copy a file from the chair, this example makes one: a simulated study, written as
# the recordings that a chair would have made (``lad-study export`` to MCAP, a file per person).

(folder / "ward.yaml").write_text(
    """\
schema: 1
name: ward
title: A limited lap alone, and one with help
cohort: {driver: {use: autonomous, options: {control_noise: 0.02}}, respondent: null}
conditions:
  alone: {limitation: {right_turn_rad_s: 0.15}}
  helped: {limitation: {right_turn_rad_s: 0.15}, assistant: demonstrator}
laps: [{condition: alone}, {condition: helped}]
analyses: [{name: help helps, condition: helped, reference: alone}]
"""
)
people = 1 if quick else 6
lad_study("run", "ward.yaml", "--participants", people, "--out", "simulated", "--no-report")
lad_study("export", "simulated", "--format", "mcap", "--out", "recordings")

# %%
# What is in it
# -------------
#
# ``--guess`` drafts a mapping from the topics that are there; you correct it.

lad_study("import", "bag", "recordings/P0001.mcap", "--guess")

# %%
# The corrected mapping, and the import. Laps run from each mark to the course's last gate; the
# model's inputs are computed as the live world computes them.

(folder / "bags.yaml").write_text(
    """\
schema: 1
protocol: ward.yaml
pose: {topic: /odom}
scan: {topic: /scan}
intent: {topic: /intent}
arbitrated: {topic: /arbitrated}
executed: {topic: /cmd_vel}
takeover: {topic: /takeover_would}
demonstrator: {topic: /demonstrator}
starts: {topic: /lap, text: '"start"'}
model: none
"""
)
bags = [f"recordings/P{i:04d}.mcap" for i in range(1, people + 1)]
lad_study("import", "bag", *bags, "--map", "bags.yaml", "--out", "ward")

# %%
# The report
# ----------

lad_study("report", "ward")

# %%
# Lap times of the recordings are those of the study that they came from, to the control step.

before, after = open_study(folder / "simulated"), open_study(folder / "ward")
columns = ["participant", "condition", "lap_time_s"]
laps = before.laps.to_pandas()[columns].merge(after.laps.to_pandas()[columns], on=columns[:2])
print(laps.round(2).to_string(index=False))

figure, axes = plt.subplots(figsize=(6, 4.5), layout="constrained")
draw_plan(axes, after.course)
for lap, colour in ((0, "C3"), (1, "C2")):
    way = after.steps("P0001", lap, ["x_m", "y_m"]).to_pandas()
    axes.plot(way.x_m, way.y_m, color=colour, label=("alone", "helped")[lap])
axes.legend(frameon=False)
