#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What was measured as wrong, and the tests that hold it: measured.py ROOT [--table]. measured.txt has a line for each: what | before | after | test @ file. Prints
which line has no test any more; --table: prints all as a table. Exit code 1 if a test is missing."""
import sys
from pathlib import Path

root = Path(sys.argv[1])
rows = []
for line in Path(__file__).with_name("measured.txt").read_text().splitlines():
    if line and line[0] != "#":
        rest, _, where = line.rpartition(" | ")
        rows.append([*(cell.strip() for cell in rest.split(" | ")), *where.rsplit(" @ ", 1)])
missing = 0
if "--table" in sys.argv:
    print("| measured | before | after | held by |\n| --- | --- | --- | --- |")
for what, before, after, test, file in rows:
    text = (root / file).read_text() if (root / file).is_file() else ""
    suite, _, name = test.rpartition(".")
    isThere = any(f"{macro}({suite}, {name})" in text for macro in ("TEST", "TEST_F", "TEST_P")) if suite.isidentifier() and name.isidentifier() else test in text
    if not isThere:
        missing += 1
        print(f"measured.txt: {what}: expected the test {test} in {file}")
    elif "--table" in sys.argv:
        print(f"| {what} | {before} | {after} | {test}, {file} |".replace("0|0", "0, 0"))
print(f"{missing} of {len(rows)} without a test" if missing else f"{len(rows)} measured lines, each held by a test")
sys.exit(missing != 0)
