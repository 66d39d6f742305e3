#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Which of two vibrations is stronger? Trials and data by PsychoPy, vibration by physvib play, answers in the terminal: no window.

    psychopy-strength.py P01 strength 10 --device JACK:system [further options of physvib play]

asks participant P01 ten times for each difference in level and writes strength.csv, one row per trial. Then

    physvib analyse psychometric strength.csv --columns participant=participant,level_db=level_db,correct=correct

fits the psychometric function. Run it with PsychoPy's own Python; where PsychoPy is missing, the stand-ins below do what this
experiment needs of it and write the same file.
"""
import random
import signal
import sys
import time

from player import Player

try:
    from psychopy import core, data
except ImportError:
    core = data = None

DAY = "86400"
STANDARD, LEVELS_DB = 0.25, (1, 2, 4, 8)  # share of full scale; the other one is so much stronger
SECONDS, GAP_SECONDS, LEAD_SECONDS = 0.3, 0.4, 0.2


class Clock:
    """Like psychopy.core.Clock."""

    def __init__(self):
        self.begun = time.monotonic()

    def getTime(self):
        return time.monotonic() - self.begun


class Trials:
    """Like psychopy.data.TrialHandler with method='random': every condition once, shuffled, then again."""

    def __init__(self, trialList, nReps, method="random", name="trials"):
        self.order = [trial for _ in range(nReps) for trial in random.sample(trialList, len(trialList))]

    def __iter__(self):
        for trial in self.order:
            self.experiment.entry.update(trial)
            yield trial

    def addData(self, name, value):
        self.experiment.entry[name] = value


class Experiment:
    """Like psychopy.data.ExperimentHandler: entries, and a wide table of them."""

    def __init__(self, name, extraInfo, savePickle=False, saveWideText=False):
        self.extra, self.entries, self.entry = extraInfo, [], {}

    def addLoop(self, trials):
        trials.experiment = self

    def nextEntry(self):
        self.entries.append({**self.entry, **self.extra})
        self.entry = {}

    def saveAsWideText(self, name, delim=","):
        columns = list(dict.fromkeys(column for entry in self.entries for column in entry))
        with open(name, "x", encoding="utf-8-sig") as table:  # a comma behind each cell, as PsychoPy writes them
            for cells in [columns, *([entry.get(column, "") for column in columns] for entry in self.entries)]:
                table.write("".join(f"{cell}{delim}" for cell in cells) + "\n")


def feel(player, trial):
    """Both vibrations are handed over at once: their distance is exact to the sample, whatever Python does meanwhile."""
    stronger = STANDARD * 10 ** (trial["level_db"] / 20)
    levels = (stronger, STANDARD) if trial["stronger"] == 1 else (STANDARD, stronger)
    for i, level in enumerate(levels):
        player.say("phantom", place="A", seconds=SECONDS, level=level, **{"in": LEAD_SECONDS + i * (SECONDS + GAP_SECONDS)})
    time.sleep(LEAD_SECONDS + 2 * SECONDS + GAP_SECONDS)


def answer():
    """1 or 2; none where the input ends."""
    while True:
        print("stronger: 1 or 2? ", end="", flush=True)
        line = sys.stdin.readline()
        if not line:
            return None
        if line.strip() in ("1", "2"):
            return int(line)
        print("psychopy-strength: expected 1 or 2", file=sys.stderr)


def main():
    try:
        participant, name, repetitions = sys.argv[1], sys.argv[2], int(sys.argv[3])
        if repetitions < 1 or name.startswith("-"):
            raise ValueError
    except (IndexError, ValueError):
        sys.exit("psychopy-strength: expected PARTICIPANT NAME REPETITIONS and options of physvib play, like P01 strength 10 --device JACK:system")
    player = Player("--layout", "phone1", "--seconds", DAY, *sys.argv[4:])
    conditions = [{"level_db": db, "stronger": which} for db in LEVELS_DB for which in (1, 2)]
    experiment = (data.ExperimentHandler if data else Experiment)(name=name, extraInfo={"participant": participant}, savePickle=False, saveWideText=False)
    trials = (data.TrialHandler if data else Trials)(conditions, repetitions, method="random", name="trials")
    experiment.addLoop(trials)
    for trial in trials:
        feel(player, trial)
        clock = core.Clock() if core else Clock()
        given = answer()
        if given is None:
            break
        trials.addData("answer", given)
        trials.addData("correct", int(given == trial["stronger"]))
        trials.addData("rt", round(clock.getTime(), 4))
        experiment.nextEntry()
    experiment.saveAsWideText(name + ".csv", delim=",")
    player.process.send_signal(signal.SIGINT)
    sys.exit(player.process.wait())


if __name__ == "__main__":
    main()
