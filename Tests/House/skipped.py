#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What a landing did not run: skipped.py [--quiet] [--kept FILE] [--at-night NAME]... BUILD_FOLDER JUNIT.xml...

Lists every test that was skipped or is disabled, whole or in part, with the reason and the script that runs it instead, of Tests/House/skips.txt.
Exit code 1 for one that is not kept there, and for tests that were left out because a program they need was not found. `--quiet`: only what is wrong.
`--at-night NAME`: tests that this run left to the night, by their entry there, a pattern of the programs and libraries that they need.
"""
import argparse, re, subprocess, sys
import xml.etree.ElementTree as xml
from fnmatch import fnmatchcase
from pathlib import Path

root = Path(__file__).resolve().parents[2]
words = argparse.ArgumentParser()
words.add_argument("--quiet", action="store_true")
words.add_argument("--kept", type=Path, default=root / "Tests/House/skips.txt")
words.add_argument("--at-night", action="append", default=[])
words.add_argument("build", type=Path)
words.add_argument("reports", nargs="+")
given = words.parse_args()

# What a test that passed says of parts that it did not run: GoogleTest, unittest, node, our scripts.
PARTS = re.compile(r"^\[  SKIPPED \] .*|^  YOU HAVE \d+ DISABLED TESTS?|^OK \(.*skipped=\d+.*\)|^# skipped [1-9]\d*|^(?:[\w.-]+: )?skipped[:,] .*", re.M)


def kept() -> "dict[str, tuple[str, str]]":
    lines = (line.split(" | ") for line in given.kept.read_text().splitlines() if not line.startswith("#"))
    found = {name: (why, instead) for name, why, instead in lines}
    for name, (_, instead) in found.items():
        script, *step = instead.split()
        steps = subprocess.run([root / script, "--list"], capture_output=True, text=True).stdout.split() if step else []
        if not (root / script).is_file() or not set(step) <= set(steps):
            faults.append(f"{name}: {instead} does not exist")
    return found


def skips(report: str) -> "list[tuple[str, str]]":
    """Of each such test its name, and what it says."""
    found = []
    for case in xml.parse(report).getroot().iter("testcase"):
        name, words = case.get("name", ""), case.find("skipped")
        parts = PARTS.findall(case.findtext("system-out") or "") if case.get("status") == "run" else []
        if case.get("status") == "disabled" or words is not None:
            found.append((name, "disabled" if case.get("status") == "disabled" else "skipped"))
        elif parts:
            found.append((name, "; ".join(dict.fromkeys(part.strip() for part in parts))))
    return found


faults: "list[str]" = []
reasons, told = kept(), set()
for name, word in (pair for report in given.reports for pair in skips(report)):
    entry = next((pattern for pattern in reasons if fnmatchcase(name, pattern)), None)
    if entry is None:
        faults.append(f"{name}: {word}, and Tests/House/skips.txt has no reason for it")
    elif not given.quiet and name not in told:
        print(f"not run here: {name} ({word}): {reasons[entry][0]}; {reasons[entry][1]} does")
    told.add(name)
for name in filter(None, given.at_night):
    if name not in reasons:
        faults.append(f"{name}: Tests/House/skips.txt has no reason for it")
    elif not given.quiet:
        print(f"not run here: {name}: {reasons[name][0]}; {reasons[name][1]} does")
for line in (given.build / "CMakeCache.txt").read_text().splitlines():
    if re.match(r"PHYSVIB_\w+:\w+=.*-NOTFOUND$|(UNICORN|CAPSTONE)_FOUND:INTERNAL=$", line) and not any(
        fnmatchcase(line.split(":")[0], name) for name in given.at_night
    ):
        faults.append(f"tests are left out: {line}")
print("\n".join(faults), end="\n" if faults else "", file=sys.stderr)
sys.exit(1 if faults else 0)
