#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Do the questions of newcomers find their answers? questions.py ROOT SITE [--all]: SITE is a folder that Docs/Site/site.py made. Each question of questions.txt is typed into the
site's search (scored as Docs/Site/search.js does it); the answer has to be in one of the first three parts. Prints those that are not (with --all: where each is), and how many are."""
import json
import re
import sys
from pathlib import Path

root, site = Path(sys.argv[1]), Path(sys.argv[2])
parts = json.loads((site / "words.js").read_text().removeprefix("words = ").rstrip().rstrip(";"))


def folded(text):
    return text.lower().replace("-", "")


def score(part, words):
    title, text = folded(part[0]), folded(part[2])
    total = 0
    for word in words:
        times = text.count(word)
        if word not in title and times == 0:
            return 0
        total += (20 if word in title else 0) + min(times, 5)
    return total / 4 if re.match(r"changelog|decisions", part[1]) else total


found, missing = 0, []
for line in (root / "Tests/Docs/questions.txt").read_text().split("\n"):
    if not line or line.startswith("#"):
        continue
    question, typed, answer = (word.strip() for word in line.split(" | ", 2))
    words = folded(typed).split()
    best = sorted((part for part in parts if score(part, words) > 0), key=lambda part: -score(part, words))[:3]
    rank = next((i for i, part in enumerate(best, 1) if re.search(answer, part[2])), 0)
    found += rank > 0
    if rank == 0:
        missing.append(f"{question} ({typed}): expected /{answer}/ in one of: {', '.join(part[1] for part in best) or 'nothing'}")
    if "--all" in sys.argv:
        print(f"{rank}  {question}  {best[rank - 1][1] if rank else ''}")
count = found + len(missing)
print(f"{found} of {count} questions find their answer among the first three parts")
if missing:
    sys.exit("\n".join(missing))
