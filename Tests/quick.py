#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Which tests of `ctest -L quick` are not quick: quick.py BUILD_FOLDER [LIMIT_S] [PROGRAM...].

Runs each test by itself and measures its processor time (user and system), which other programs on the machine hardly change. Prints those
over the limit (0.2 s unless told), slowest first: they belong into Tests/slow.txt. Exit code 1 if there are any.
"""
import json, os, resource, subprocess, sys

build, limit, programs = sys.argv[1], float(sys.argv[2]) if len(sys.argv) > 2 else 0.2, sys.argv[3:]
listed = subprocess.run(["ctest", "--test-dir", build, "-L", "^quick$", "--show-only=json-v1"], capture_output=True, check=True).stdout
slow, total, count = [], 0.0, 0
for test in json.loads(listed)["tests"]:
    if programs and os.path.basename(test["command"][0]) not in programs:
        continue
    properties = {p["name"]: p["value"] for p in test["properties"]}
    if properties.get("DISABLED"):
        continue
    environment = os.environ | dict(v.split("=", 1) for v in properties.get("ENVIRONMENT", []))
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(test["command"], env=environment, cwd=properties.get("WORKING_DIRECTORY"), capture_output=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    total, count = total + seconds, count + 1
    if seconds > limit:
        slow.append((seconds, test["name"]))
for seconds, name in sorted(slow, reverse=True):
    print(f"{seconds:7.2f} s  {name}")
print(f"{count} quick tests, {total:.0f} s of the processor, {len(slow)} over {limit} s")
sys.exit(1 if slow else 0)
