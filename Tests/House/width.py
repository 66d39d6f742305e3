#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Lines of C++ beyond the formatter's width: width.py ROOT [--update]. The width is ColumnLimit of .clang-format; width.txt says how many lines beyond it each folder may still
have. More fails, and so does fewer: lower the number, so that it cannot grow again. --update writes the list."""
import collections
import re
import sys
from pathlib import Path

root = Path(sys.argv[1]).resolve()
allowed_file = Path(__file__).with_name("width.txt")
HEAD = "# Lines beyond the formatter's width, by folder. Numbers only go down: Tests/House/width.py ROOT --update.\n"
limit = int(re.search(r"^ColumnLimit: (\d+)", (root / ".clang-format").read_text(), re.M)[1])

found = collections.Counter()
for top in ("Source", "Standalone", "Plugin", "Firmware", "Tests"):
    for file in sorted(path for kind in ("*.h", "*.cpp") for path in (root / top).rglob(kind)):
        parts = file.relative_to(root).parts
        folder = "/".join(parts[:2] if len(parts) > 2 else parts[:1])
        found[folder] += sum(1 for line in file.read_text(encoding="utf-8").split("\n") if len(line) > limit)

if "--update" in sys.argv:
    allowed_file.write_text(HEAD + "".join(f"{folder} {count}\n" for folder, count in sorted(found.items()) if count))
allowed = dict((line.split()[0], int(line.split()[1])) for line in allowed_file.read_text().split("\n") if line and not line.startswith("#"))
bad = [f"{folder}: expected at most {allowed.get(folder, 0)} lines of more than {limit} characters, found {found[folder]}" if found[folder] > allowed.get(folder, 0)
       else f"Tests/House/width.txt: {folder} has {found[folder]}, its line says {allowed.get(folder, 0)}: lower it"
       for folder in sorted({*found, *allowed}) if found[folder] != allowed.get(folder, 0)]
if bad:
    sys.exit("\n".join(bad))
print(f"{sum(found.values())} lines of more than {limit} characters; none more than before")
