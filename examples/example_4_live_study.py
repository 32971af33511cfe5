"""
A live study with yourself
==========================

For people who want to sit in the chair before anybody else does. The protocol says who is alive;
everything else is as with synthetic people.
"""

import os
import subprocess
import sys
import tempfile
from pathlib import Path

import matplotlib.pyplot as plt

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
# With you
# --------
#
# This protocol has a living driver, who answers questions too; the demonstrator is the shipped one.

lad_study("show", "drive-yourself")

# %%
# At a prompt, ``lad-study live drive-yourself --out studies/me`` prints a link for your browser.
# You drive with keys, a gamepad or a finger: a practice lap until you are comfortable, a limited
# lap, one in which the demonstrator takes over, and one in which the model that learnt from it
# helps.
#
# Without you
# -----------
#
# Nobody sits at the machine that made this page. So the living parts are replaced by parts that
# ship: a synthetic person drives, and answers. Nothing else in the file changes, and the record has
# the same columns.

text = subprocess.run(
    [Path(sys.executable).with_name("lad-study"), "show", "drive-yourself"],
    capture_output=True, text=True, check=True,
).stdout  # fmt: skip
alone = text.replace("driver: {use: live}", "driver: {use: human}")
alone = alone.replace("respondent: {use: live}", "respondent: {use: ordinal}")
if quick:  # one lap in place of four
    alone = alone[: alone.index("laps:")] + "laps: [{condition: helped}]\n"
(folder / "alone.yaml").write_text(alone)
lad_study("run", "alone.yaml", "--seed", 4, "--out", "study", "--no-report")

# %%
# What is recorded of a lap
# -------------------------
#
# What the hand wanted, what the limitation left of it, and who had control: in every control step.
# Of living people there is more: the device, the age of each command, frames, lateness, pauses.

study = open_study(folder / "study")
lap = int(study.laps.to_pandas().query("condition == 'helped'").lap.iloc[0])
steps = study.steps("P0001", lap, ["t_s", "intent_w", "user_w", "control"]).to_pandas()
figure, axes = plt.subplots(figsize=(7, 3.2), layout="constrained")
axes.plot(steps.t_s, steps.intent_w, color="0.6", label="the hand")
axes.plot(steps.t_s, steps.user_w, label="after the limitation")
helped = steps.control == "demonstrator"
axes.fill_between(steps.t_s, -0.55, 0.55, where=helped, color="C2", alpha=0.2, label="demonstrator")
axes.set(xlabel="time / s", ylabel="turn rate / rad/s", ylim=(-0.55, 0.55))
axes.legend(frameon=False, ncols=3)
print(f"the demonstrator had control in {helped.mean():.0%} of the steps")
