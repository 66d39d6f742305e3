#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tables of Docs are what their scripts print: tables.py ROOT PHYSVIB. Where a page names `Tests/figures/NAME.sh PHYSVIB`, a script that needs nothing else, the script is run with the program, and each line
of the tables from there to the next heading has to be one that it prints, and each that it prints has to be there (timings.sh has more); the table of deviations from the thesis is compared with the list in the source, and misprints with the rows of `physvib thesis`. Prints what
differs; exit code 1 if anything does."""
import json
import re
import subprocess
import sys
from functools import lru_cache
from pathlib import Path

root = Path(sys.argv[1]).resolve()
bad = []


def rows_of(text: str) -> list:
    """Lines of tables that hold figures; heads and rules may be written in other words."""
    return [line for line in re.sub(r"^.*\n(?=\| --- )", "", text, flags=re.M).split("\n") if re.match(r"\| .*\d.* \|$", line)]


@lru_cache(None)
def printed_by(script: str) -> list:
    run = subprocess.run([root / script, sys.argv[2]], capture_output=True, encoding="utf-8")
    if run.returncode != 0:
        bad.append(f"{script}: exit code {run.returncode}: {run.stderr.strip()[-200:]}")
    return rows_of(run.stdout)


told = {f"Tests/figures/{name}.sh": [] for name in ("drop", "methods", "timings")}
for path in sorted((root / "Docs").glob("*.md")):
    for script, text in re.findall(r"`(Tests/figures/(?:drop|methods|timings)\.sh) PHYSVIB`(.*?)(?=^#|\Z)", path.read_text(), re.S | re.M):
        rows = rows_of(text)
        bad += [f"Docs/{path.name}: expected a line that {script} prints, found {row}" for row in rows if row not in printed_by(script)]
        told[script] += rows
        if not rows:
            bad.append(f"Docs/{path.name}: {script}: expected a table below its name")
for script, rows in told.items():
    if not rows:
        bad.append(f"{script}: expected a page that has its table")
    if not script.endswith("/timings.sh"):  # of which the page has a part
        bad += [f"{script}: expected a page with the line that it prints: {row}" for row in printed_by(script) if row not in rows]

cell = r'((?:"(?:[^"\\]|\\.)*"\s*)+)'  # the formatter may have cut a text in two
source = (root / "Source/Lab/Files/ProtocolFile.h").read_text()
page = (root / "Docs/studies-thesis.md").read_text()
deviations = re.findall(r"ThesisDeviation\{\s*" + r",\s*".join([cell] * 5) + r"(?:,\s*\w+::\w+)*\}", source)
lines = {f"| `{protocol}` {section} | {thesis} | {here} | {change or '-'} |" for protocol, section, thesis, here, change in ([re.sub(r'"\s*"', "", text.strip())[1:-1] for text in one] for one in deviations)}
for line in sorted(lines):
    if line not in page.split("\n"):
        bad.append(f"Docs/studies-thesis.md: expected the line of Source/Lab/Files/ProtocolFile.h: {line}")
for line in re.findall(r"^\| `[a-z-]+` \d.*\|$", page, re.M):
    if line not in lines:
        bad.append(f"Docs/studies-thesis.md: a deviation that Source/Lab/Files/ProtocolFile.h does not have: {line}")

thesis = {f"| {row['at']} | {row['misprint']} |" for row in json.loads((root / "Source/Lab/Thesis/thesis.json").read_text()) if "misprint" in row}
shown = set(re.findall(r"^\| .* \|$", (root / "Docs/thesis.md").read_text().split("## Misprints")[1], re.M)) - {"| thesis | cannot be |", "| --- | --- |"}
bad += [f"Docs/thesis.md beside Source/Lab/Thesis/thesis.json: {line}" for line in sorted(thesis ^ shown)]

if bad or not deviations:
    sys.exit("\n".join(bad or ["no deviations were read"]))
print(f"{printed_by.cache_info().currsize} scripts and {len(deviations)} deviations: the pages have their lines")
