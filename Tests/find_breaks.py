#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Finds which tests catch breaks that were made by somebody who has not seen the tests, so that no choice of tests flatters the figure.
usage: find_breaks.py ROWS BUILD FOLDER [NUMBER...]
ROWS: a file with rows as those of breaks.txt, the test of each empty; BUILD, FOLDER: as for breaks.py. All quiet tests run once, and it is noted which breaks each of them
reaches and how long it takes. Then each break (or those with the NUMBERs) is tried by the tests that reach it, the shortest first and SECONDS in all at most, until one fails that
passes without the break. Prints a row per break, then how many are caught. FOLDER/reached.json keeps what is reached: remove it when tests change."""
import concurrent.futures
import json
import os
import pathlib
import re
import subprocess
import sys
import time

import breaks

SECONDS = 240
TIMEOUT = 300
LEFT_OUT = "live|display|engines|laboratory"  # labels: real time, windows, engines of others


class Tests:
    def __init__(self, build: pathlib.Path, folder: pathlib.Path):
        self.build, self.folder = build, folder
        said = subprocess.run(["ctest", "--show-only=json-v1", "-LE", LEFT_OUT], cwd=build, capture_output=True, text=True, check=True).stdout
        self.tests = {test["name"]: test for test in json.loads(said)["tests"] if "command" in test and "DISABLED_" not in " ".join(test["command"]) and not re.match(r"(House|Docs|Release)\.", test["name"])}

    def command(self, name: str) -> tuple[list[str], str, dict[str, str]]:
        """Of that test, with what the folder has in place of the build's: the arguments, where it runs, its environment."""
        def moved(text: str) -> str:
            for place in ("bin", "lib"):
                for found in re.findall(rf"{re.escape(str(self.build))}/{place}/[\w.-]+", text):
                    ours = found.replace(str(self.build), str(self.folder))
                    if pathlib.Path(ours).exists():
                        text = text.replace(found, ours)
            return text

        test = self.tests[name]
        properties = {one["name"]: one["value"] for one in test.get("properties", [])}
        environment = {**os.environ, "LD_LIBRARY_PATH": f"{self.folder}/lib", "LOCPATH": str(self.build / "Tests/locale")}
        environment.update(text.split("=", 1) for text in properties.get("ENVIRONMENT", []))
        return [moved(word) for word in test["command"]], properties.get("WORKING_DIRECTORY", str(self.build)), environment

    def run(self, name: str, more: dict[str, str]) -> str:
        """How that test ends: "" if it passes or is skipped."""
        words, place, environment = self.command(name)
        try:
            done = subprocess.run(words, cwd=place, env={**environment, **more}, capture_output=True, timeout=TIMEOUT)
        except subprocess.TimeoutExpired:
            return "time"
        return "" if done.returncode in (0, 77) else "failed"

    def reach(self, count: int) -> dict[str, tuple[float, list[int]]]:
        """Of each test that reaches a break: its seconds, and the breaks' numbers."""
        kept = self.folder / "reached.json"
        if kept.exists():
            return json.loads(kept.read_text())

        def one(name: str) -> tuple[str, float, list[int], str]:
            marks = self.folder / f"marks-{abs(hash(name))}"
            marks.write_bytes(bytes(count + 1))
            began = time.monotonic()
            end = self.run(name, {"PHYSVIB_BREAK": "0", "PHYSVIB_BREAKS_REACHED": str(marks)})
            reached = [number for number, mark in enumerate(marks.read_bytes()) if mark]
            marks.unlink()
            return name, time.monotonic() - began, reached, end

        found: dict[str, tuple[float, list[int]]] = {}
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            for at, (name, seconds, reached, end) in enumerate(pool.map(one, self.tests)):
                if end:
                    print(f"{name} {end} without a break, and is left out", flush=True)
                elif reached:
                    found[name] = (seconds, reached)
                if at % 100 == 99:
                    print(f"{at + 1} of {len(self.tests)} tests", flush=True)
        kept.write_text(json.dumps(found))
        return found


def main() -> None:
    file, build, folder = (pathlib.Path(name).resolve() for name in sys.argv[1:4])
    rows = [breaks.Break(number, line) for number, line in enumerate((line for line in file.read_text().splitlines() if line and line[0] != "#"), 1)]
    if missing := breaks.without_a_place(rows):
        sys.exit("\n".join(missing))
    tests = Tests(build, folder)
    if not (folder / "reached.json").exists():
        targets = subprocess.run(["ninja", "-t", "targets", "all"], cwd=build, capture_output=True, text=True, check=True).stdout
        breaks.Overlay(build, folder, rows).make(sorted(set(re.findall(r"^(bin/[\w-]+): CXX_EXECUTABLE", targets, re.MULTILINE))))
    reached = tests.reach(len(rows))

    def attempt(row: breaks.Break) -> tuple[breaks.Break, str, int, float]:
        names = sorted((name for name, (_, numbers) in reached.items() if row.number in numbers), key=lambda name: reached[name][0])
        spent = 0.0
        for name in names:
            spent += reached[name][0]
            if spent > SECONDS:
                break
            if tests.run(name, {"PHYSVIB_BREAK": str(row.number)}) and not tests.run(name, {"PHYSVIB_BREAK": "0"}):
                return row, name, len(names), spent
        return row, "", len(names), spent

    chosen = [row for row in rows if not sys.argv[4:] or str(row.number) in sys.argv[4:]]
    caught = 0
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for row, by, count, spent in pool.map(attempt, chosen):
            caught += by != ""
            breaks.print_end(row, by, by or f"{count} tests reach it, {spent:.0f} s")
    breaks.exit_with(caught, len(chosen))


if __name__ == "__main__":
    main()
