# SPDX-License-Identifier: GPL-3.0-or-later
"""Two sessions like the one that was played, with strikes at the times that tags alone say: the first strike's, and so much later as
its tag is; and the same 0.02 frame later. Usage: tags.py SESSION.json TAGS BY_TAGS.json LATER.json"""
import json
import sys

session, tags, by_tags, later = sys.argv[1:]
played = json.load(open(session))
strikes = played["strikes"]
tags = sorted(int(line) for line in open(tags))
assert len(strikes) == len(tags), (len(strikes), len(tags))
strikes.sort(key=lambda s: s["time_s"])
ns = [round(s["time_s"] * 1e9) for s in strikes]
away = [n - ns[0] - (tag - tags[0]) for n, tag in zip(ns, tags)]
print(f"tags: {len(tags)}, strikes at most {max(map(abs, away))} ns away from where the first one and their tags say")
for path, shift in (by_tags, 0), (later, 417):
    for strike, tag in zip(strikes, tags):
        strike["time_s"] = (ns[0] + tag - tags[0] + shift) / 1e9
    json.dump(played, open(path, "w"))
