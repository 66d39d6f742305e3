#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What screens.sh asks, on the display at hand: screens.py BIN_FOLDER FOLDER [STUDY...]. Trials before each session are answered by the simulated
observer in a person's name; then the mixer is started on the rows, and keys go on from there."""
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

BIN, OUT = Path(sys.argv[1]), Path(sys.argv[2])
DISPLAY_SIZE = os.environ["PHYSVIB_DISPLAY"]
BREAK_S = 8


def run(*words, **more) -> str:
    return subprocess.run([str(w) for w in words], capture_output=True, text=True, check=True, **more).stdout


def keys(*names: str, between_s: float = 0.25) -> None:
    for name in names:
        run("xdotool", "key", name)
        time.sleep(between_s)


def picture(name: str) -> None:
    time.sleep(0.4)
    path = OUT / f"{name}-{DISPLAY_SIZE}.png"
    run("ffmpeg", "-loglevel", "error", "-y", "-f", "x11grab", "-video_size", DISPLAY_SIZE, "-i", os.environ["DISPLAY"], "-frames:v", "1", path)


class Mixer:
    """The mixer on a protocol, from the tab Studies to the participant's first page."""

    def __init__(self, protocol: Path, rows: Path, tab: str = "") -> None:
        home = rows / "config"
        shutil.rmtree(home, ignore_errors=True)
        environment = os.environ | {"XDG_CONFIG_HOME": str(home), "HOME": str(rows)}
        words = [BIN / "physvib-mixer", "--device", "None:no device", "--study", protocol, "--participant", "P01", "--number", "1", "--out", rows]
        self.program = subprocess.Popen([str(w) for w in words], env=environment, cwd=rows)
        self.window = run("xdotool", "search", "--sync", "--onlyvisible", "--name", "PhysVib mixer").split()[0]
        run("xdotool", "windowactivate", "--sync", self.window)
        time.sleep(1.5)
        if tab:
            picture(tab)
        self.begin()

    def begin(self) -> None:
        words = run("xdotool", "getwindowgeometry", "--shell", self.window)
        x, y, width, height = (int(re.search(rf"^{name}=(-?\d+)", words, re.M)[1]) for name in ("X", "Y", "WIDTH", "HEIGHT"))
        at = BEGIN_BUTTONS[DISPLAY_SIZE]
        run("xdotool", "mousemove", x + at[0], y + at[1], "click", "1")
        run("xdotool", "mousemove", x + width - 3, y + height // 2) # not over a button
        time.sleep(4.0) # every world is looked at first

    def kill(self) -> None:
        self.program.kill()
        self.program.wait()


BEGIN_BUTTONS = {"1280x720": (858, 338), "1440x900": (951, 493)} # in the window of that display


# ---- rows of a person, up to a trial

def protocol_of(name: str, folder: Path) -> tuple:
    """The built-in protocol with breaks of some seconds, as a file, and what is in it."""
    protocol = json.loads(run(BIN / "physvib", "study", "show", name))
    if protocol.get("condition_break_s"):
        protocol["condition_break_s"] = BREAK_S
    for session in protocol["sessions"]:
        for field in ("break_before_s", "break_s"):
            if session.get(field):
                session[field] = BREAK_S
    path = folder / f"{name}.json"
    path.write_text(json.dumps(protocol))
    return path, protocol


def whole_rows(protocol: Path, folder: Path) -> list:
    run(BIN / "physvib", "study", "run", protocol, "--observer", "simulated", "--participants", "1", "--out", folder / "whole")
    rows = next((folder / "whole").glob("*-P01.csv"))
    return [line.replace("simulated", "person") for line in rows.read_text().splitlines(keepends=True)]


def start_of(lines: list, condition: str, session: str) -> int:
    """The line of the first trial of that session in that condition."""
    names = next(line for line in lines if not line.startswith("#")).strip().split(",")
    at = names.index("condition"), names.index("session"), names.index("trial")
    for n, line in enumerate(lines):
        cells = line.split(",")
        if len(cells) > max(at) and [cells[k] for k in at] == [condition, session, "1"]:
            return n
    raise SystemExit(f"no trial of {session} in {condition}")


# ---- hands

def feel(seconds: float) -> None:
    keys("space")
    time.sleep(seconds)


def shake(parts: int, least_s: float) -> None:
    for part in range(1, parts + 1):
        keys(str(part))
        until = time.time() + least_s + 1.0
        while time.time() < until:
            keys("Left", "Left", "Right", "Right", between_s=0.3)
    keys("space")
    time.sleep(1.0)


ANSWERS = {"identify": ("Down", "Return"), "locate": ("Left", "Left", "Up", "Return"), "choose": ("2",), "estimate": ("1", "2"),
           "adjust": ("Up", "Up"), "rate": ("Tab", "Right", "Right", "Tab", "Left", "Tab", "Right")}


def length_s(condition: dict) -> float:
    found = re.search(r"--seconds ([0-9.]+)", condition.get("call", ""))
    return 1.2 + (float(found[1]) if found else 1.2)


def take_trial(condition: dict, session: dict, name: str) -> None:
    """A trial of that session, seen before, while it is felt, and with its answer."""
    picture(f"{name}-2-trial")
    task = session.get("task", "identify")
    if task == "explore":
        keys(*(("a",) if condition["stimuli"] == "patterns" else ("Left", "Up", "Return")))
        time.sleep(length_s(condition))
    elif condition.get("hands"):
        keys("1")
        keys("Left", "Left", "Left")
        picture(f"{name}-3-felt")
        shake(len(session["objects"]), session["least_s"])
    else:
        for part in range(max(1, len(session.get("alternatives", [])))):
            keys("space", between_s=0.1)
            if part == 0:
                picture(f"{name}-3-felt")
            time.sleep(length_s(condition))
    keys(*(("b",) if condition["stimuli"] == "patterns" and task == "identify" else ANSWERS.get(task, ())))
    picture(f"{name}-4-answered")


def show_session(name: str, protocol: Path, lines: list, condition: dict, session: dict, before: dict | None, folder: Path) -> None:
    rows = folder / f"{condition['name']}-{session['name']}"
    rows.mkdir()
    at = start_of(lines, condition["name"], session["name"])
    if at > 2:
        (rows / f"{name}-P01.csv").write_text("".join(lines[:at]))
    shown = f"{name}-{condition['name']}-{session['name']}"
    mixer = Mixer(protocol, rows, tab=f"{shown}-0-tab" if at <= 2 else "")
    if before is not None and before.get("task") == "explore": # who explores ends that by Next
        keys("Return", between_s=BREAK_S)
        width, height = (int(word) for word in DISPLAY_SIZE.split("x"))
        run("xdotool", "mousemove", width // 2, height - 42, "click", "1", "mousemove", width - 3, height // 2)
        time.sleep(1.0)
    picture(f"{shown}-1-before")
    time.sleep(BREAK_S)
    keys("Return", between_s=0.8)
    take_trial(condition, session, shown)
    mixer.kill()


def show_end(name: str, protocol: Path, lines: list, condition: dict, session: dict, folder: Path) -> None:
    """The last trial, and what follows it."""
    rows = folder / "end"
    rows.mkdir()
    (rows / f"{name}-P01.csv").write_text("".join(lines[:-1]))
    mixer = Mixer(protocol, rows)
    time.sleep(BREAK_S)
    keys("Return", between_s=0.8)
    take_trial(condition, session, f"{name}-end")
    keys("Return", between_s=0.8)
    picture(f"{name}-end-5-after")
    mixer.kill()


# ---- a whole session, with all that may happen to it

WHOLE = {"physvib_protocol": 1, "name": "whole", "conditions": [{"name": "c", "layout": "phone4", "stimuli": "grid", "columns": 2, "rows": 1, "seconds": 0.3}],
         "sessions": [{"name": "practice", "training": True, "task": "identify", "order": "given"},
                      {"name": "main", "task": "identify", "order": "given", "repetitions": 4, "break_every": 4, "break_s": BREAK_S}]}


SPOTS = {"1280x720": {"Feel it": (640, 230), "right": (865, 462), "Next": (640, 678), "Begin": (640, 519)},
         "1440x900": {"Feel it": (720, 230), "right": (1125, 552), "Next": (720, 858), "Begin": (720, 609)}}


def click(title: str) -> None:
    run("xdotool", "mousemove", *SPOTS[DISPLAY_SIZE][title], "click", "1", "mousemove", int(DISPLAY_SIZE.split("x")[0]) - 3, "300")
    time.sleep(0.8)


def answer(trial: int) -> None:
    """The first of two points by keys, the second by the pointer; their order is given, so all answers are right."""
    if trial % 2:
        feel(1.0)
        keys("Left", "Return", "Return", between_s=0.4)
    else:
        click("Feel it")
        click("right")
        click("Next")
    time.sleep(0.4)


def show_whole(folder: Path) -> None:
    protocol, rows = folder / "whole.json", folder / "rows"
    rows.mkdir()
    protocol.write_text(json.dumps(WHOLE))
    file = rows / "whole-P01.csv"

    def expect_trials(count: int, after: str) -> None:
        found = len(file.read_text().splitlines()) - 2
        if found != count:
            raise SystemExit(f"{DISPLAY_SIZE}: {found} instead of {count} trials after {after}")

    mixer = Mixer(protocol, rows)
    picture("whole-1-before")
    keys("Return", between_s=0.8)
    answer(1), answer(2)
    click("Begin")
    for trial in range(1, 5):
        answer(trial)
    picture("whole-2-break")
    click("Begin") # too early
    time.sleep(BREAK_S)
    picture("whole-3-rested")
    click("Begin")
    answer(5), answer(6)
    feel(0.1)
    mixer.kill()
    expect_trials(8, "a kill while something was felt")
    mixer = Mixer(protocol, rows)
    picture("whole-4-resumed")
    keys("Return", between_s=0.8)
    answer(7)
    keys("alt+F4", between_s=1.0)
    picture("whole-5-window-closed")
    click("Begin")
    picture("whole-6-gone-on")
    keys("alt+F4", "alt+F4", between_s=1.0)
    picture("whole-7-left")
    expect_trials(9, "the window was closed twice")
    mixer.begin()
    keys("Return", between_s=0.8)
    answer(8)
    picture("whole-8-end")
    mixer.kill()
    expect_trials(10, "all")
    events = [line.split(",")[1] for line in (rows / "whole-P01.times.txt").read_text().splitlines()[1:]]
    expected = ["start", "break", "go-on", "resume", "pause", "go-on", "pause", "leave", "resume", "end"]
    if events != expected:
        raise SystemExit(f"{DISPLAY_SIZE}: the file of times has {events}, expected {expected}")
    run(BIN / "physvib", "report", file, "--protocol", protocol, "--out", folder / "report")
    sittings = re.search(r"<tr>(<td>P01</td><td>20.*?)</tr>", (folder / "report/index.html").read_text())
    print(f"{DISPLAY_SIZE}: 10 of 10 trials after a break, a kill and a closed window. {re.sub('<[^>]*>', ' ', sittings[1])}")


def main() -> None:
    manager = subprocess.Popen(["openbox"])
    names = sys.argv[3:] or [line.split()[0] for line in run(BIN / "physvib", "study", "list").splitlines() if not line.split()[0].endswith("-thesis")] + ["whole"]
    with tempfile.TemporaryDirectory() as scratch:
        for name in names:
            folder = Path(scratch) / name
            folder.mkdir()
            if name == "whole":
                show_whole(folder)
                continue
            path, protocol = protocol_of(name, folder)
            lines = whole_rows(path, folder)
            conditions = protocol["conditions"]
            for condition in {c["name"]: c for c in (conditions[0], conditions[-1])}.values():
                before = None
                for session in protocol["sessions"]:
                    show_session(name, path, lines, condition, session, before, folder)
                    before = session
            if protocol.get("closing_question") or name == "magnitudes":
                show_end(name, path, lines, conditions[-1], protocol["sessions"][-1], folder)
    manager.terminate()


if __name__ == "__main__":
    main()
