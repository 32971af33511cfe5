"""
A live study with yourself
==========================

For people who want to sit in the chair before anybody else does. The protocol says who is alive;
everything else is as with synthetic people.
"""

import json
import os
import subprocess
import sys
import tempfile
import time
from math import atan2, remainder, tau
from pathlib import Path
from urllib.parse import urlsplit

import matplotlib.pyplot as plt
from websockets.sync.client import connect

from protocols.course.centreline import Centreline
from protocols.load import load_course
from protocols.record.reader import open_study

quick = bool(os.environ.get("LAD_STUDY_QUICK"))
work = tempfile.TemporaryDirectory()  # take a folder of your own to keep what is made
folder = Path(work.name)


def lad_study(*arguments: object) -> str:
    """Run a command as at a prompt, show what it prints, and return it."""
    command = [Path(sys.executable).with_name("lad-study"), *map(str, arguments)]
    done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=folder)
    print("$ lad-study", *arguments)
    print(done.stdout)
    if done.returncode:
        raise SystemExit(done.stderr)
    return done.stdout


# %%
# With you
# --------
#
# This protocol has a living driver, who answers questions too; the demonstrator is the shipped one.

text = lad_study("show", "drive-yourself")

# %%
# At a prompt, ``lad-study live drive-yourself --out studies/me`` prints a link for your browser.
# You drive with keys, a gamepad or a finger: a practice lap until you are comfortable, a limited
# lap, one in which the demonstrator takes over, and one in which the model that learnt from it
# helps.
#
# With a program in your place
# ----------------------------
#
# Nobody sits at the machine that made this page. So a program opens the participant's link, as your
# browser would: it gets the same pages and pictures, and sends where its stick stands. One lap is
# enough here. The server, the clock on the wall and the record are those of a study with people.

time_limit_s = 3 if quick else 120
lap = "condition: helped, survey: [{instrument: driving-assistance, items: all}]"
text = text[: text.index("laps:")] + f"laps: [{{{lap}, time_limit_s: {time_limit_s}}}]\n"
(folder / "one-lap.yaml").write_text(text)

line = Centreline(load_course("lab-office"))


def stick(pose: list[float], so_far: float) -> tuple[float, float, float]:
    """Return the stick towards the line 0.8 m ahead: forward, left, and how far along it is."""
    x, y, heading = pose
    so_far, _ = line.locate(x, y, so_far)
    goal = line.point(min(so_far + 0.8, line.length))
    aside = remainder(atan2(goal.y - y, goal.x - x) - heading, tau)
    return max(0.0, 1 - abs(aside)), max(-1.0, min(1.0, 2 * aside)), so_far


def take_part(link: str) -> int:
    """Go through a session in the participant's seat; return how many pictures were shown."""
    host, token = urlsplit(link).netloc, link.rpartition("/")[2]
    shown, so_far = 0, 0.0
    with connect(f"ws://{host}/ws", origin=f"http://{host}", max_size=2**20) as seat:
        seat.send(json.dumps({"type": "hello", "token": token}))
        for message in map(json.loads, seat):
            reply = None
            if message["type"] == "page":  # a check, instructions, questions: 3 is the middle
                asked = message.get("questions", [])
                given = {f"{q['instrument']}.{q['item']}": 3 for q in asked}
                reply = {"type": "answer", "request": message["request"], "entered": given}
            elif message["type"] == "ping":
                reply = {"type": "pong", "id": message["id"]}
            elif message["type"] == "picture":
                forward, left, so_far = stick(message["pose"], so_far)
                shown += 1
                now = 1000 * time.monotonic()
                reply = {"type": "input", "n": shown, "sent": now, "f": forward, "l": left}
            if reply is not None:
                seat.send(json.dumps(reply))
    return shown


arguments = ["live", "one-lap.yaml", "--port", "0", "--links", "links.json"]
arguments += ["--out", "study", "--no-report"]
print("$ lad-study", *arguments)
command = [Path(sys.executable).with_name("lad-study"), *arguments]
with subprocess.Popen(command, cwd=folder, stdout=subprocess.DEVNULL) as server:
    links = folder / "links.json"
    while not links.exists() and server.poll() is None:
        time.sleep(0.05)
    print(take_part(json.loads(links.read_text())["participant"]), "pictures were shown")
assert server.returncode == 0

# %%
# What is recorded of a lap
# -------------------------
#
# What the hand wanted, what the limitation left of it, and who had control: in every control step.

study = open_study(folder / "study")
columns = ["t_s", "intent_w", "user_w", "control", "driver_sent_age_s", "late_s"]
steps = study.steps("P0001", 0, columns).to_pandas()
figure, axes = plt.subplots(figsize=(7, 3.2), layout="constrained")
axes.plot(steps.t_s, steps.intent_w, color="0.6", label="the hand")
axes.plot(steps.t_s, steps.user_w, label="after the limitation")
helped = steps.control == "demonstrator"
axes.fill_between(steps.t_s, -0.55, 0.55, where=helped, color="C2", alpha=0.2, label="demonstrator")
axes.set(xlabel="time / s", ylabel="turn rate / rad/s", ylim=(-0.55, 0.55))
axes.legend(frameon=False, ncols=3)
print(f"the demonstrator had control in {helped.mean():.0%} of the steps")

# %%
# Of living people there is more: how long ago each input was sent when it was used, how late a step
# began by the clock on the wall, the device, pauses, pictures drawn. Where synthetic people are to
# drive the same protocol, write ``driver: {use: human}`` and ``respondent: {use: ordinal}`` in
# place of ``live``; nothing else changes.

delays = 1000 * steps[["driver_sent_age_s", "late_s"]]  # ms
print(delays.describe(percentiles=[0.5, 0.99]).loc[["50%", "99%", "max"]].round(1).to_string())
