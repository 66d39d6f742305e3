#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The table of stops in Docs/silence.md is held: stops.py ROOT. Each row has whole milliseconds, none above its bound; what holds it exists and reads that bound,
or is a test of that name; Docs/safety.md points there and tells no figure of its own that the table does not have. Prints what is wrong."""
import re
import sys
from pathlib import Path

root = Path(sys.argv[1]).resolve()
page = (root / "Docs/silence.md").read_text()
tests = "\n".join(path.read_text() for path in (root / "Tests").rglob("*.cpp"))
scripts = {path.relative_to(root).as_posix(): path.read_text() for kind in ("*.sh", "*.py") for path in (root / "Tests").rglob(kind)}
bad = []
section = page.split("## Measured\n")[1].split("\n## ")[0]
rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in section.split("\n") if line.startswith("| ")][2:]
for row in rows:
    if len(row) != 6 or not all(re.fullmatch(r"\d+", cell) for cell in row[1:5]):
        bad.append(f"{row[0]}: expected median, worst, of and at most in whole numbers, found {row[1:5]}")
        continue
    median, worst, count, most = map(int, row[1:5])
    if not 0 <= median <= worst <= most or count < 1:
        bad.append(f"{row[0]}: expected median <= worst <= at most, found {median}, {worst}, {most}")
    for name in re.findall(r"`([^`]+)`", row[5]):
        if "/" in name:
            if row[0] not in scripts.get(name, "") or "silence.md" not in scripts.get(name, ""):
                bad.append(f"{row[0]}: expected {name} to measure it and to read its bound here")
        elif not re.search(rf"TEST(_F)?\({name.replace('.', ', ')}\)", tests):
            bad.append(f"{row[0]}: there is no test {name}")
if len(rows) < 7:
    bad.append(f"Docs/silence.md: expected the table of stops, found {len(rows)} rows")
safety = (root / "Docs/safety.md").read_text()
stop = next(line for line in safety.split("\n") if line.startswith("| stop |"))
if "silence.md#measured" not in stop or re.search(r"within \d+ ms", stop):
    bad.append("Docs/safety.md: stop: expected the way to silence.md#measured and no figure of its own")
if bad:
    sys.exit("\n".join(bad))
print(f"{len(rows)} doors: each with its milliseconds, held by what measures them")
