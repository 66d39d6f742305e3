#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tables of Docs are what their scripts print: tables.py ROOT PHYSVIB. Runs each script with the program and compares its tables, line by line, with those of its
page; the table of deviations from the thesis is compared with the list in the source. Prints what differs; exit code 1 if anything does."""
import re
import subprocess
import sys
from pathlib import Path

root = Path(sys.argv[1]).resolve()
pages = {"drop.sh": ["drop.md"], "methods.sh": ["methods.md"], "levels.sh": ["studies-thesis.md"]}
bad = []


def rows_of(text: str) -> list:
    """Lines of tables that hold figures; heads and rules may be written in other words."""
    return [line for line in text.split("\n") if re.match(r"\| .*\d.* \|$", line)]


for script, names in pages.items():
    printed = subprocess.run([root / "Tests/figures" / script, sys.argv[2]], capture_output=True, encoding="utf-8")
    if printed.returncode != 0:
        bad.append(f"Tests/figures/{script}: exit code {printed.returncode}: {printed.stderr.strip()[-200:]}")
        continue
    found = [line for name in names for line in rows_of((root / "Docs" / name).read_text())]
    for line in rows_of(printed.stdout):
        if line not in found:
            bad.append(f"Docs/{names[0]}: expected the line that Tests/figures/{script} prints, found none like it: {line}")

cell = r'((?:"(?:[^"\\]|\\.)*"\s*)+)'  # the formatter may have cut a text in two
source = (root / "Source/Lab/Study/ThesisDeviations.h").read_text()
page = (root / "Docs/studies-thesis.md").read_text()
deviations = re.findall(r"ThesisDeviation\{\s*" + r",\s*".join([cell] * 5) + r"(?:,\s*ThesisEdit::\w+)?\}", source)
lines = {f"| `{protocol}` {section} | {thesis} | {here} | {change or '-'} |" for protocol, section, thesis, here, change in ([re.sub(r'"\s*"', "", text.strip())[1:-1] for text in one] for one in deviations)}
for line in sorted(lines):
    if line not in page.split("\n"):
        bad.append(f"Docs/studies-thesis.md: expected the line of Source/Lab/Study/ThesisDeviations.h: {line}")
for line in re.findall(r"^\| `[a-z-]+` \d.*\|$", page, re.M):
    if line not in lines:
        bad.append(f"Docs/studies-thesis.md: a deviation that Source/Lab/Study/ThesisDeviations.h does not have: {line}")

if bad or not deviations:
    sys.exit("\n".join(bad or ["no deviations were read"]))
print(f"{len(pages)} scripts and {len(deviations)} deviations: the pages have their lines")
