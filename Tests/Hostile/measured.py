#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What was measured as wrong, and the tests that hold it: measured.py ROOT BUILD [--table]. measured.txt has a line for each: what | before | after | test @ file => what
judges it there. A line is held if the file has the test, the line that judges stands in it (of a script: in no comment), and it runs: ctest has the test or calls the file, or nightly.sh
does. Prints what is not held; --table: prints all as a table. Exit code 1 if one is not."""
import json
import re
import subprocess
import sys
from pathlib import Path

root, build = map(Path, sys.argv[1:3])
listed = json.loads(subprocess.run(["ctest", "--test-dir", build, "--show-only=json-v1"], capture_output=True, check=True, text=True).stdout)["tests"]
filtered = {word.partition("=")[2] for test in listed for word in test.get("command", []) if word.startswith("--gtest_filter=")}
names = {re.sub(r"^\w+/|/\w+$", "", name) for name in filtered}
calls = [[word for word in test.get("command", []) if not word.startswith("--gtest_filter=-")] for test in listed]  # all but some
whole = {Path(call[-1]) for call in calls if call and call[-1].endswith("-tests")}  # programs that run what they have, in a window
built = b"".join(program.read_bytes() for program in whole if program.is_file())
nightly = "".join((root / path).read_text() for path in ("Tests/nightly.sh", "Tests/javascript.sh"))


def whereItRuns(test, file, isOfSuite):
    if isOfSuite:
        return "ctest" if test in names or test.rpartition(".")[2].encode() in built else ""
    tables = [(root / file).parent / "CMakeLists.txt", root / "Tests/CMakeLists.txt"]
    if file.endswith(".cpp") or any(Path(file).name in re.sub("#.*", "", table.read_text()) for table in tables if table.is_file()):
        return "ctest"
    return "by night" if re.search(rf"\b{re.escape(Path(file).stem)}\b", nightly) else ""


def fault(test, file, judge):
    """Empty, or why the line is not held; and where it runs."""
    text = (root / file).read_text() if (root / file).is_file() else ""
    suite, _, name = test.rpartition(".")
    isOfSuite = suite.isidentifier() and name.isidentifier()
    if isOfSuite:
        body = re.search(rf"^TEST(_F|_P)?\({suite}, {name}\).*?^}}", text, re.S | re.M)
        text = body[0] if body else ""
    else:
        text = "\n".join(line for line in text.splitlines() if not line.lstrip().startswith("#"))
        text = text if test in text else ""
    if not text:
        return f"expected the test {test} in {file}", ""
    if judge not in text:
        return f"expected {judge} in {test}, {file}", ""
    runs = whereItRuns(test, file, isOfSuite)
    return "" if runs else f"{test}, {file}: neither ctest nor nightly.sh runs it", runs


rows = []
for line in Path(__file__).with_name("measured.txt").read_text().splitlines():
    if line and line[0] != "#":
        rest, _, judge = line.partition(" => ")
        rest, _, where = rest.rpartition(" | ")
        rows.append([*(cell.strip() for cell in rest.split(" | ")), *where.rsplit(" @ ", 1), judge])
if "--table" in sys.argv:
    print("| measured | before | after | held by | judged by | runs |\n| --- | --- | --- | --- | --- | --- |")
missing = 0
for what, before, after, test, file, judge in rows:
    wrong, runs = fault(test, file, judge)
    missing += wrong != ""
    if wrong:
        print(f"measured.txt: {what}: {wrong}")
    elif "--table" in sys.argv:
        print(f"| {what} | {before} | {after} | {test}, {file} | `{judge}` | {runs} |".replace("0|0", "0, 0"))
print(f"{missing} of {len(rows)} not held" if missing else f"{len(rows)} measured lines, each held by a test that runs and judges it")
sys.exit(missing != 0)
