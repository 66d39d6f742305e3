# SPDX-License-Identifier: MIT
"""The example for PsychoPy, without a device and without a window: psychopy_example.py ROOT PHYSVIB. A program that writes down what it is told stands in for
physvib play; the example runs with its own stand-ins and with a module psychopy of this test, and `physvib analyse` reads both tables."""
import csv
import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT, PHYSVIB = Path(sys.argv.pop(1)), sys.argv.pop(1)
EXAMPLE = ROOT / "Standalone/Examples/psychopy-strength.py"

PLAYER = """#!/usr/bin/env python3
import os, signal, sys
signal.signal(signal.SIGINT, lambda *_: os.set_blocking(0, False)) # what was said before is read, then it ends
with open(os.environ["TOLD"], "w") as told:
    told.write(" ".join(sys.argv[1:]) + "\\n")
    told.flush()
    while True:
        try:
            said = os.read(0, 65536)
        except BlockingIOError:
            break
        if not said:
            break
        told.write(said.decode())
        told.flush()
"""

# The same order each time, and no longer sleep than until the player is there.
HURRY = """
import os, random, time
random.seed(3)
def hurry(_, sleep=time.sleep):
    while not os.path.exists(os.environ["TOLD"]):
        sleep(0.01)
time.sleep = hurry
"""

# PsychoPy's own classes, as far as the example asks them: a wide table with a mark at its beginning and a comma behind each cell.
PSYCHOPY = """
class Handler:
    def __init__(self, trialList, nReps, method="random", name=""):
        assert method == "random"
        self.trialList, self.nReps = trialList, nReps
    def __iter__(self):
        for self.thisTrial in [dict(t) for _ in range(self.nReps) for t in self.trialList]:
            yield self.thisTrial
    def addData(self, name, value):
        self.experiment.row[name] = value
class ExperimentHandler:
    def __init__(self, name="", extraInfo=None, savePickle=True, saveWideText=True):
        assert not savePickle and not saveWideText, "the example saves by itself"
        self.extraInfo, self.rows, self.row = extraInfo, [], {}
    def addLoop(self, loop):
        self.loop, loop.experiment = loop, self
    def nextEntry(self):
        self.rows.append({"trials.thisN": len(self.rows), **self.loop.thisTrial, **self.row, **self.extraInfo})
        self.row = {}
    def saveAsWideText(self, fileName, delim=None):
        with open(fileName, "w", encoding="utf-8-sig") as f:
            for cells in [list(self.rows[0])] + [list(row.values()) for row in self.rows]:
                f.write("".join(str(cell) + delim for cell in cells) + "\\n")
TrialHandler = Handler
"""


class PsychoPyExample(unittest.TestCase):
    def setUp(self) -> None:
        self.home = tempfile.TemporaryDirectory()
        self.folder = Path(self.home.name)
        player = self.folder / "player"
        player.write_text(PLAYER)
        player.chmod(0o755)
        self.environment = {**os.environ, "PHYSVIB": str(player), "TOLD": str(self.folder / "told"), "PYTHONDONTWRITEBYTECODE": "1"}
        self.environment.pop("DISPLAY", None)
        self.modules = self.folder / "modules"
        self.modules.mkdir()
        (self.modules / "sitecustomize.py").write_text(HURRY)
        self.environment["PYTHONPATH"] = str(self.modules)

    def tearDown(self) -> None:
        self.home.cleanup()

    def run_example(self, answers: str, *words: str) -> "subprocess.CompletedProcess[str]":
        return subprocess.run([sys.executable, EXAMPLE, *words], input=answers, cwd=self.folder, env=self.environment, capture_output=True, encoding="utf-8", timeout=120)

    def check(self, answers: str, trials: int) -> None:
        ran = self.run_example(answers, "P01", "strength", "1", "--device", "none")
        self.assertEqual(ran.returncode, 0, ran.stderr)
        with open(self.folder / "strength.csv", encoding="utf-8-sig", newline="") as table:
            rows = list(csv.DictReader(table))
        self.assertEqual(len(rows), trials)
        told = (self.folder / "told").read_text().splitlines()
        self.assertTrue(told[0].endswith("--listen --layout phone1 --seconds 86400 --device none"), told[0])
        felt = [json.loads(line) for line in told[1:]]
        for i, row in enumerate(rows):
            first, second = felt[2 * i : 2 * i + 2]
            self.assertAlmostEqual(second["in"] - first["in"], 0.7)
            louder, softer = (first, second) if row["stronger"] == "1" else (second, first)
            self.assertEqual(softer["level"], 0.25)
            self.assertAlmostEqual(louder["level"], 0.25 * 10 ** (float(row["level_db"]) / 20))
            self.assertEqual(row["participant"], "P01")
            self.assertEqual(row["correct"], str(int(row["answer"] == row["stronger"])))
        analysed = subprocess.run([PHYSVIB, "analyse", "psychometric", "strength.csv", "--columns", "participant=participant,level_db=level_db,correct=correct"], cwd=self.folder, capture_output=True, encoding="utf-8")
        # eight answers are read, and are too few to tell a JND: that is said of the participant, and of nothing else
        self.assertIn("strength.csv: nobody can be fitted; participant P01 left out:", analysed.stderr)

    def test_without_psychopy_its_own_lines_write_the_table(self) -> None:
        (self.modules / "psychopy.py").write_text("raise ImportError('none here')\n")  # also where it is installed
        self.check("1\n3\n2\n1\n2\n1\n2\n1\n2\n", 8)  # a 3 is asked again

    def test_with_psychopy_its_handlers_write_the_table(self) -> None:
        package = self.modules / "psychopy"
        package.mkdir()
        (package / "__init__.py").write_text("")
        (package / "data.py").write_text(PSYCHOPY)
        (package / "core.py").write_text("import time\nclass Clock:\n    def __init__(self): self.t = time.time()\n    def getTime(self): return time.time() - self.t\n")
        self.check("2\n2\n1\n2\n1\n2\n1\n2\n", 8)
        self.assertIn("trials.thisN", (self.folder / "strength.csv").read_text(encoding="utf-8-sig"))

    def test_wrong_words_are_one_line(self) -> None:
        for words in (["P01"], ["P01", "strength", "none"], ["P01", "--device", "3"]):
            ran = self.run_example("", *words)
            self.assertNotEqual(ran.returncode, 0)
            self.assertEqual(ran.stderr.count("\n"), 1, ran.stderr)
            self.assertIn("expected PARTICIPANT NAME REPETITIONS", ran.stderr)


if __name__ == "__main__":
    unittest.main()
