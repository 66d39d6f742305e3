#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Breaks the code in the ways that breaks.txt lists, one after the other, and says which of them its tests catch.
usage: breaks.py --check | BUILD FOLDER [WORD...]
--check: only whether each break has its place in the code, in a second. BUILD: a build in which all test programs are; it stays as it is. FOLDER: for the sources with their
breaks, and what is compiled of them. All breaks are compiled at once, and PHYSVIB_BREAK says which one a program has. WORD: only rows with that word. A row is
`file|what stands there|what is put there|what a user loses|program:filter`; BROKEN in the third is true in the broken program, ¦ stands for |, \\n for a new line; without BROKEN the
third stands for the second, a statement if that ends in a semicolon. A break is caught if that test fails with it and passes without. Exit code 1 if a place is missing, or fewer
than nine of ten are caught."""
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
SWITCH = """#pragma once
#ifdef __cplusplus
#include <cstdlib>
#include <fcntl.h>
#include <sys/mman.h>
struct BreakSwitch { // before main: the render role may not make system calls
    int chosen = std::getenv("PHYSVIB_BREAK") != nullptr ? std::atoi(std::getenv("PHYSVIB_BREAK")) : 0;
    char* reached = nullptr; // a byte for each break, of find_breaks.py
    BreakSwitch() {
        if (const char* file = std::getenv("PHYSVIB_BREAKS_REACHED")) {
            void* bytes = mmap(nullptr, 4096, PROT_READ | PROT_WRITE, MAP_SHARED, open(file, O_RDWR), 0);
            if (bytes != MAP_FAILED) reached = static_cast<char*>(bytes);
        }
    }
};
inline BreakSwitch breakSwitch;
inline bool isBroken(int number) {
    if (breakSwitch.reached != nullptr) breakSwitch.reached[number] = 1;
    return breakSwitch.chosen == number;
}
#endif
"""
SECONDS = 300


class Break:
    def __init__(self, number: int, line: str):
        self.number = number
        self.file, self.old, self.new, self.what, self.test = (part.replace("¦", "|").replace("\\n", "\n") for part in line.split("|"))

    def put_into(self, text: str) -> str:
        if "BROKEN" in self.new:
            new = self.new.replace("BROKEN", f"isBroken({self.number})")
        elif self.old.endswith(";"):
            new = f"{{ if (isBroken({self.number})) {{ {self.new} }} else {{ {self.old} }} }}"
        else:
            new = f"(isBroken({self.number}) ? ({self.new}) : ({self.old}))"
        return text.replace(self.old, new)


def breaks() -> list[Break]:
    lines = (ROOT / "Tests/breaks.txt").read_text().splitlines()
    rows = [Break(number, line) for number, line in enumerate((line for line in lines if line and line[0] != "#"), 1)]
    texts = {str(path.relative_to(ROOT)): path.read_text() for folder in ("Source", "Plugin", "Standalone", "Firmware") for path in (ROOT / folder).rglob("*") if path.suffix in (".cpp", ".h")}
    for row in rows:  # code moves
        if texts.get(row.file, "").count(row.old) != 1:
            places = [file for file, text in texts.items() if text.count(row.old) == 1]
            row.file = places[0] if len(places) == 1 else row.file
    return rows


def without_a_place(rows: list[Break]) -> list[str]:
    def count(row: Break) -> int:
        path = ROOT / row.file
        return path.read_text().count(row.old) if path.exists() else 0

    return [f"{row.file}: {row.old}: {count(row)} places" for row in rows if count(row) != 1]


class Overlay:
    """What the breaks change of a build, compiled and linked anew in a folder: the build's own commands, on a copy of all sources that has the breaks."""

    def __init__(self, build: pathlib.Path, folder: pathlib.Path, rows: list[Break]):
        self.build, self.folder, self.tree = build, folder, folder / "sources"
        self.source = pathlib.Path(re.search(r"CMAKE_HOME_DIRECTORY:INTERNAL=(.*)", (build / "CMakeCache.txt").read_text())[1])
        self.outputs: dict[str, str] = {}  # of the build, relative to it: made anew
        broken: dict[str, str] = {}
        for row in rows:
            broken[row.file] = row.put_into(broken.get(row.file) or (ROOT / row.file).read_text())
        known = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True, check=True).stdout
        for file in filter(None, known.split("\0")):
            if (ROOT / file).is_file():
                self.write(self.tree / file, broken[file].encode() if file in broken else (ROOT / file).read_bytes())
        places = build / "Tests/Places/TestPlaces.h"  # which programs the tests call
        self.write(self.tree / "Places/TestPlaces.h", places.read_text().replace(f"{build}/bin", f"{folder}/bin").encode())
        self.write(folder / "Switch.h", SWITCH.encode())
        self.changed = {str(self.source / file): self.tree / file for file in broken} | {str(places): self.tree / "Places/TestPlaces.h"}
        self.deps = self.read_deps()

    @staticmethod
    def write(path: pathlib.Path, data: bytes) -> None:
        path.parent.mkdir(parents=True, exist_ok=True)
        if not path.exists() or path.read_bytes() != data:
            path.write_bytes(data)

    def read_deps(self) -> dict[str, set[str]]:
        found: dict[str, set[str]] = {}
        for line in subprocess.run(["ninja", "-t", "deps"], cwd=self.build, capture_output=True, text=True, check=True).stdout.splitlines():
            if line.startswith(" "):
                found[output].add(os.path.normpath(self.build / line.strip()))
            elif line:
                output = line.split(":")[0]
                found[output] = set()
        return found

    def moved(self, text: str) -> str:
        """The sources' paths in a command or a file that is compiled, those of the copy; what was unpacked in build/, as JUCE, stays there."""
        text = text.replace(f"{self.build}/Tests/Places", f"{self.tree}/Places")
        return re.sub(rf"{re.escape(str(self.source))}(?!/build/|{re.escape(str(self.build)[len(str(self.source)) :])})(?=[/\"]|$)", str(self.tree), text)

    def compile(self, words: list[str]) -> None:
        at = words.index("-o")
        output, source = words[at + 1], words[words.index("-c") + 1]
        needs = self.deps.get(output, set()) | {source}
        if not needs & self.changed.keys():
            return
        new = self.folder / output
        new.parent.mkdir(parents=True, exist_ok=True)
        self.outputs[output] = str(new)
        read = pathlib.Path(self.moved(source))
        if "/Unity/" in source:  # names the files that are compiled together
            read = self.folder / "Unity" / pathlib.Path(source).relative_to(self.build)
            self.write(read, self.moved(pathlib.Path(source).read_text()).encode())
        flags = [self.moved(word) for word in words[:at] if word != "-Werror" and not word.startswith("-W")]
        copies = [self.changed.get(name) or self.tree / pathlib.Path(name).relative_to(self.source) for name in needs if name in self.changed or name.startswith(f"{self.source}/")]
        if not new.exists() or any(copy.exists() and copy.stat().st_mtime > new.stat().st_mtime for copy in copies):
            self.calls.append(([*flags, "-O1", "-w", "-include", str(self.folder / "Switch.h"), "-o", str(new), "-c", str(read)], output))

    def link(self, words: list[str]) -> None:
        output = words[words.index("-o") + 1] if "-o" in words else words[words.index("qc") + 1]
        if not any(word in self.outputs for word in words if word != output):
            return
        new = self.folder / output
        new.parent.mkdir(parents=True, exist_ok=True)
        inputs = [self.outputs.get(word, word) for word in words]
        self.outputs[output] = str(new)
        self.links.append(([str(new) if word == output else word for word in inputs] + (["-Wl,--enable-new-dtags"] if "-o" in words else []), output))

    def make(self, programs: list[str]) -> None:
        self.calls, self.links = [], []
        said = subprocess.run(["ninja", "-t", "commands", *programs], cwd=self.build, capture_output=True, text=True, check=True).stdout
        for line in said.splitlines():
            for part in line.split(" && "):
                words = shlex.split(part)
                if "-c" in words and "-o" in words and words[words.index("-o") + 1].endswith(".o"):
                    while words[0].endswith(("cmake", "ccache")) or words[0] in ("-E", "env") or "=" in words[0]:
                        words.pop(0)
                    self.compile(words)
                elif words and (words[0].endswith("/ar") or (words[0].endswith("c++") and "-o" in words)):
                    self.link(words)
        running: list[tuple[subprocess.Popen, str]] = []
        failed: list[str] = []
        for call, output in [*self.calls, ([], "")]:
            while len(running) >= (os.cpu_count() or 2) or (not call and running):
                process, name = running.pop(0)
                if process.wait():
                    failed.append(f"{name}: does not compile with its breaks")
            if call:
                print(f"compiles {output}", flush=True)
                running.append((subprocess.Popen(call, cwd=self.build), output))
        if failed:
            sys.exit("\n".join(failed))
        for call, output in self.links:
            new = pathlib.Path(self.outputs[output])
            new.unlink(missing_ok=True)
            if subprocess.run(call, cwd=self.build).returncode:
                sys.exit(f"{output}: does not link with its breaks")
            if ".so." in output:  # by its shorter names as well
                for end in range(2):
                    short = new.with_name(".".join(new.name.split(".")[: 2 + end]))
                    if short != new:
                        short.unlink(missing_ok=True)
                        short.symlink_to(new)
                        self.outputs[str(pathlib.Path(output).with_name(short.name))] = str(short)


def fails(folder: pathlib.Path, build: pathlib.Path, test: str, number: int) -> str:
    """How that test ends with that break: "" if it passes."""
    program, _, only = test.partition(":")
    at = folder / "bin" / program
    environment = {**os.environ, "PHYSVIB_BREAK": str(number), "LD_LIBRARY_PATH": f"{folder}/lib", "LOCPATH": str(build / "Tests/locale")}
    try:
        done = subprocess.run([at if at.exists() else build / "bin" / program, f"--gtest_filter={only}"], capture_output=True, text=True, timeout=SECONDS, env=environment, errors="replace")
    except subprocess.TimeoutExpired:
        return "time"
    if "0 tests ran" in done.stdout or "[==========] Running 0 tests" in done.stdout:
        return "no such test" if number == 0 else ""
    return (re.findall(r"\[  FAILED  \] ([\w./]+)", done.stdout) or ["ended"])[0] if done.returncode else ""


def print_end(row: Break, by: str, why: str) -> None:
    print(f"{row.number:3} {'caught' if by else 'NOT CAUGHT':10} {row.file}: {row.what} ({why})", flush=True)


def exit_with(caught: int, count: int) -> None:
    print(f"{caught} of {count} caught")
    sys.exit(caught * 10 < count * 9)


def main() -> None:
    rows = breaks()
    if missing := without_a_place(rows):
        sys.exit("\n".join(missing) + f"\n{len(missing)} of {len(rows)} breaks have no place of their own in the code")
    if sys.argv[1] == "--check":
        return print(f"{len(rows)} breaks have their places")
    build, folder = (pathlib.Path(name).resolve() for name in sys.argv[2 - 1 : 3])
    chosen = [row for row in rows if not sys.argv[3:] or any(word in f"{row.number}|{row.file}|{row.test}|{row.what}" for word in sys.argv[3:])]
    programs = sorted({row.test.split(":")[0] for row in chosen})
    called = ["physvib", "physvib-render"] if {"physvib-commandline-tests", "physvib-board-tests"} & set(programs) else []
    Overlay(build, folder, rows).make([f"bin/{name}" for name in programs + called])
    caught = 0
    passes: dict[str, str] = {}
    for row in chosen:
        if row.test not in passes:
            passes[row.test] = fails(folder, build, row.test, 0)
        if passes[row.test]:
            print(f"{row.number:3} UNBROKEN   {row.test} does not pass as it is: {passes[row.test]}", flush=True)
            continue
        by = fails(folder, build, row.test, row.number)
        caught += by != ""
        print_end(row, by, by)
    exit_with(caught, len(chosen))


if __name__ == "__main__":
    main()
