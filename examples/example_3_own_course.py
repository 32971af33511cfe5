"""
Your own course from a robot's map
==================================

For people who want to simulate the building that they have. A robot with a laser draws a map (ROS's
``map_server``: a picture and a YAML file). A route says which way through it; walls, gates and
sections follow.
"""

import os
import subprocess
import sys
import tempfile
from pathlib import Path

import matplotlib.pyplot as plt
from PIL import Image, ImageDraw

from analysis.figures.plan import draw_plan
from protocols.load import load_course
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
# The map
# -------
#
# Where a robot would have driven, this example draws: a floor of 10 by 8 m with a block in it, at
# 5 cm a cell. White is free, black a wall, grey unknown, as ROS has it.

cell = 0.05
picture = Image.new("L", (220, 180), 205)
draw = ImageDraw.Draw(picture)
draw.rectangle((10, 10, 209, 169), fill=254, outline=0, width=2)
draw.rectangle((70, 60, 150, 110), fill=0)
draw.rectangle((20, 30, 27, 60), fill=0)
picture.save(folder / "hall.pgm")
(folder / "hall.yaml").write_text(
    "image: hall.pgm\nresolution: 0.05\norigin: [0.0, 0.0, 0.0]\nnegate: 0\n"
    "occupied_thresh: 0.65\nfree_thresh: 0.196\n"
)

# %%
# The route
# ---------
#
# Points to pass, clockwise around the block. A gate stands at each that has a name; the last one is
# the finish. ``lad-study import map hall.yaml`` drafts this file beside a picture with a grid.

(folder / "route.yaml").write_text(
    """\
schema: 1
name: hall
title: Around the block of the hall
start: {x: 2.0, y: 4.0, heading: 1.5708}
via:
  - [2.2, 7.4]
  - [9.0, 7.2]
  - [9.0, 2.0]
  - [3.0, 2.0]
gates: [north-west, north-east, south-east, finish]
"""
)
lad_study("import", "map", "hall.yaml", "--route", "route.yaml", "--out", "hall-course.yaml")

# %%
# Drive it
# --------
#
# A study of two laps, for any course. Nobody helps in it, so that nothing has to be taught.

(folder / "two-laps.yaml").write_text(
    """\
schema: 1
name: two-laps
title: What the limitation costs here
course: hall-course.yaml
cohort: {driver: {use: autonomous, options: {control_noise: 0.02}}}
conditions:
  free: {}
  limited: {limitation: {right_turn_rad_s: 0.15}}
laps: [{condition: free}, {condition: limited}]
"""
)
people = 1 if quick else 6
lad_study("run", "two-laps.yaml", "--participants", people, "--out", "study", "--no-report")
record = open_study(folder / "study")
laps = record.laps.to_pandas()
print(laps.groupby("condition").lap_time_s.agg(["count", "mean"]).round(1))

# %%
# The course, with the ways that were driven in the limited lap.

figure, axes = plt.subplots(figsize=(6.5, 5), layout="constrained")
draw_plan(axes, load_course(str(folder / "hall-course.yaml")))
for lap in laps[laps.condition == "limited"].itertuples():
    way = record.steps(lap.participant, lap.lap, ["x_m", "y_m"]).to_pandas()
    axes.plot(way.x_m, way.y_m, linewidth=1, label=lap.participant)
axes.legend(frameon=False)
