#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Compares what the C libraries show with the baseline that is kept in abi/: a line per change. Exit code 1 if a program that was built against
the baseline would not go on working with what is there now. Releases have no debug information, so types come from the headers: each function
of a header gets an empty body, and abidw reads the library that is made of them. Its symbols have to be those of the library that was built.
abi.py ROOT FOLDER_OF_LIBRARIES [--renew]; --renew: what is there now becomes the baseline"""
import platform
import re
import subprocess
import sys
import tempfile
from pathlib import Path

root, built = Path(sys.argv[1]).resolve(), Path(sys.argv[2])
kept = Path(__file__).resolve().parent / "abi"
surfaces = [("libphysvib", root / "Source/Api/C/physvib.h"), ("libphysvib-live", root / "Source/Api/Live/physvib-live.h")]
unsized = ("physvib_motors",)  # arrays of it are handed over: it cannot grow (Docs/stable.md)


def output(*command: object) -> str:
    return subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, text=True, check=True).stdout


def symbols(library: Path) -> set[str]:
    return {line.split()[-1] for line in output("nm", "-D", "--defined-only", library).splitlines()}


def make_surface(header: Path, library: Path) -> None:
    """The library's symbols with the header's types, and nothing in them."""
    bodies = re.sub(r"PHYSVIB_API ([^;{}#]*);", r"PHYSVIB_API \1 { __builtin_trap(); }", header.read_text())
    source = library.with_suffix(".c")
    source.write_text(bodies.replace("<physvib/physvib.h>", '"physvib.h"'))
    soname = re.search(r"SONAME.*\[(.*)\]", output("readelf", "-d", built / f"{library.stem}.so")).group(1)
    output("gcc", "-g", "-w", "-shared", "-fPIC", f"-I{root}/Source/Api/C", source, f"-Wl,--version-script={header.with_suffix('.map')}",
           f"-Wl,-soname={soname}", "-o", library)


def is_compatible(change: str) -> bool:
    """A new function, or members at the end of a structure whose size its caller says. One in a gap would leave the size as it was."""
    lines = [line.strip() for line in change.splitlines()]
    if lines[0].startswith("[A] 'function "):
        return True
    of = re.fullmatch(r"'struct (\w+)' changed:", lines[0])
    grown = re.fullmatch(r"type size changed from (\d+) to \d+ \(in bits\)", lines[1]) if of else None
    if grown is None or of.group(1) in unsized or not re.fullmatch(r"\d+ data member insertions?:", lines[2]):
        return False
    members = [re.fullmatch(r"'.*', at offset (\d+) \(in bits\)", line) for line in lines[3:]]
    return all(member and int(member.group(1)) >= int(grown.group(1)) for member in members)


def changes(baseline: Path, surface: Path) -> list[str]:
    """Those that abidiff reports: a line "[A]", "[C]" or "[D]" for each symbol, a paragraph for each type, and headings between them."""
    done = subprocess.run(["abidiff", "--leaf-changes-only", "--no-show-locs", str(baseline), str(surface)], stdout=subprocess.PIPE, text=True)
    paragraphs = [part.strip("\n") for part in re.split(r"\n\s*\n|\n(?=\s*\[[ACD]\] )", done.stdout) if part.strip()]
    found = [part for part in paragraphs if not re.match(r"(ELF SONAME|Leaf changes|\d+ (Added|Removed|Changed|function|variable)) ?", part)]
    if done.returncode & 3 or (done.returncode != 0) != bool(found):  # 1, 2: it could not compare them; 4, 8: they differ
        found.append(f"abidiff: exit code {done.returncode}: {done.stdout}")
    return found


if platform.machine() != "x86_64":
    sys.exit("abi: the baseline is of x86-64, and this machine is another")
bad = 0
with tempfile.TemporaryDirectory() as folder:
    for name, header in surfaces:
        surface, baseline = Path(folder) / f"{name}.so", kept / f"{name}.abi"
        make_surface(header, surface)
        for symbol in sorted(symbols(surface) ^ symbols(built / surface.name)):
            print(f"{name}: {symbol} is in the header or in the library, not in both")
            bad += 1
        if "--renew" in sys.argv:
            baseline.write_text(output("abidw", "--no-corpus-path", "--no-comp-dir-path", "--no-show-locs", surface).replace(folder + "/", ""))
        for change in changes(baseline, surface):
            fits = is_compatible(change)
            bad += not fits
            print(f"{name}: {'fits' if fits else 'INCOMPATIBLE'}: {' '.join(change.split())}")
print(f"abi: {bad} incompatible" if bad else "abi: programs built against the baseline go on working")
sys.exit(bad > 0)
