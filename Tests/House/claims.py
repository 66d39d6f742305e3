#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Every claim that something was felt or played names its receipt: claims.py ROOT [--list]. A claim is a string of Standalone, Source/Lab/Report, Plugin or
Source/Api that says so of what happened (not of what will: "is felt", "to be felt"). claims.txt has a line for each: file | beginning of the string | what it reads.
That is a name that must stand in a file, `name @ file`, or `none: reason` where nothing is claimed. Prints what is wrong; exit code 1 if anything is."""
import re
import sys
from pathlib import Path

root = Path(sys.argv[1]).resolve()
table = Path(__file__).with_name("claims.txt")
places = ("Standalone", "Source/Lab/Report", "Plugin", "Source/Api")
endings = {".cpp", ".h", ".js", ".mjs", ".ts", ".html", ".gd", ".cs", ".lua", ".py"}
strings = re.compile(r'"((?:[^"\\\n]|\\.)*)"')
claims = re.compile(r"\b(was|were|been) (not )?(felt|played)\b|^ ?felt $|\b(collisions|strikes|events|hits) (played|left)\b|^ played,|\bfelt (once|\{n\} times)|\bnobody felt\b"
                    r"|\bleft (through|for|at)\b|\b(that|they|parts?|trials?|what) left\b|reach the output|through the device|\bplayed for\b|^Felt $", re.I)


def claims_of(path: Path):
    text = "\n".join(line for line in path.read_text(errors="replace").split("\n") if not line.lstrip().startswith(("//", "#include", "*")))
    for match in strings.finditer(re.sub(r'"\s*\n\s*"', "", text)):
        words = match[1].strip()
        if claims.search(match[1]):
            yield words


found = [(p.relative_to(root).as_posix(), words) for place in places for p in sorted((root / place).rglob("*")) if p.suffix in endings for words in claims_of(p)]
if "--list" in sys.argv:
    for name, words in dict.fromkeys(found):
        print(f"{name} | {words[:60]} | ")
    sys.exit(0)

rows = [[cell.strip() for cell in line.split(" | ")] for line in table.read_text().split("\n") if line and not line.startswith("#")]
bad = [f"claims.txt: expected file | string | receipt, found {row}" for row in rows if len(row) != 3]
rows = [row for row in rows if len(row) == 3]
for name, words in dict.fromkeys(found):
    if not any(name == row[0] and words.startswith(row[1]) for row in rows):
        bad.append(f'{name}: "{words}": says that something was felt or played, and claims.txt does not say by which receipt')
for name, words, receipt in rows:
    if not any(name == at and text.startswith(words) for at, text in found):
        bad.append(f'claims.txt: {name}: "{words}" is not said there any more')
    if receipt.startswith("none: "):
        continue
    token, _, at = receipt.partition(" @ ")
    if not at or not (root / at).is_file() or token not in (root / at).read_text():
        bad.append(f'claims.txt: {name}: "{words}": expected a receipt that is read, name @ file, found "{receipt}"')
print("\n".join(bad) or f"{len(rows)} claims, each with its receipt")
sys.exit(bool(bad))
