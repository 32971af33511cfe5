"""
The record with pandas, DuckDB and R
====================================

For people who analyse with their own tools. A study directory is Parquet and JSON: nothing of this
project is needed to read it.
"""

import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import duckdb
import matplotlib.pyplot as plt
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


people = 1 if quick else 8
(folder / "study.yaml").write_text(
    """\
schema: 1
name: record
title: A study to read
cohort: {respondent: null}
conditions:
  free: {}
  limited: {limitation: {right_turn_rad_s: 0.15}}
laps: [{condition: free}, {condition: limited}]
"""
)
lad_study("run", "study.yaml", "--participants", people, "--out", "record", "--no-report")

# %%
# pandas
# ------

laps = pd.read_parquet(folder / "record" / "laps.parquet")
print(laps.groupby("condition").lap_time_s.describe()[["count", "mean", "std"]].round(1))

# %%
# Every column is explained in ``codebook.json``.

book = json.loads((folder / "record" / "codebook.json").read_text())
(clearance,) = (c for c in book["tables"]["steps"] if c["name"] == "clearance_m")
print(clearance["description"], clearance["unit"], sep="; ")

# %%
# DuckDB
# ------
#
# One query over the step tables of all people; the path of a file says who it is.

steps = folder / "record" / "sessions" / "*" / "steps-*.parquet"
query = """
    SELECT regexp_extract(filename, 'P[0-9]+') AS participant,
           regexp_extract(filename, 'steps-([0-9]+)', 1)::INT AS lap,
           count(*) AS steps, min(clearance_m) AS nearest_m, avg(abs(executed_w)) AS turning_rad_s
    FROM read_parquet(?, filename = true)
    GROUP BY ALL ORDER BY ALL
"""
found = duckdb.execute(query, [str(steps)]).df()
print(found.head(6).round(3).to_string(index=False))

figure, axes = plt.subplots(figsize=(6, 3.2), layout="constrained")
joined = found.merge(laps, on=["participant", "lap"])
for condition, rows in joined.groupby("condition"):
    axes.plot(rows.turning_rad_s, rows.lap_time_s, "o", label=condition)
axes.set(xlabel="mean turn rate / rad/s", ylabel="lap time / s")
axes.legend(frameon=False)

# %%
# R
# -
#
# ``lad-study export record --format r`` writes CSV files and ``read.R``, which gives columns the
# classes of the codebook. This is text, not run here; the test suite runs ``lap_times.R``, which
# begins like this:
#
# .. code-block:: r
#
#    source("export/read.R")
#    laps <- subset(laps, !practice & completed)
#    aggregate(lap_time_s ~ condition, laps, mean)

lad_study("export", "record", "--format", "r", "--out", "export")
print(*sorted(path.name for path in (folder / "export").iterdir()))
