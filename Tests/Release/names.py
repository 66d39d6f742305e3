#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What people write by name, and its promise: names.py ROOT FOLDER_OF_PROGRAMS [--update]. Commands and options are asked of the programs, fields of files,
messages and parameters are read from the tables that the programs are made of. Fails where a name of promised-names.txt is gone; --update
adds new ones. A promised name is taken off that list by hand alone. C's names are abi.py's."""
import json
import re
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

root, programs = Path(sys.argv[1]), Path(sys.argv[2])
listed = Path(__file__).with_name("promised-names.txt")


def output(*command: object) -> str:
    return subprocess.run([str(word) for word in command], check=True, capture_output=True, text=True).stdout


def options() -> Iterator[str]:
    with tempfile.TemporaryDirectory() as folder:
        output(programs / "physvib", "--reference", folder)
        command = "physvib"
        for line in (Path(folder) / "md" / "physvib.md").read_text().splitlines():
            if heading := re.match(r"##+ `([^`]+)`", line):
                command = heading[1]
                yield command
            elif option := re.match(r"\| `(.+?)` \|", line):
                yield f"{command} {option[1]}"
            elif line.startswith("As `"): # options of another command's table
                yield from (f"{command} {name}" for name in re.findall(r"`(.+?)`", line)[1:])
    for option in re.findall(r"^ +(?:-\w, *)?(--[\w-]+)", output(programs / "physvib-render", "--help"), re.M):
        yield f"physvib-render {option}"


def fields() -> Iterator[str]:
    for file in (file for house in ("Source", "Plugin", "Standalone") for file in sorted((root / house).rglob("*")) if file.suffix in (".h", ".cpp")):
        owner = file.stem
        for structure, part, name in re.findall(r'FieldsOf<(?:\w+::)*(\w+)>|void visit(\w+)\(auto& v\)|\b(?:v\.\w+\(|optionalField\(v, )"(\w+)"', file.read_text()):
            owner = structure or (part if f'FieldsOf<{part}>' in file.read_text() else '') or owner
            if name:
                yield f"field {owner} {name}"
        for mark in re.findall(r'VersionField = "(\w+)"|checkVersion\(root, "(\w+)"', file.read_text()):
            yield f"file {''.join(mark)}"


def properties(schema: object, place: str) -> Iterator[str]:
    if isinstance(schema, list):
        for part in schema:
            yield from properties(part, place)
    elif isinstance(schema, dict):
        for key, value in schema.items():
            if key == "properties":
                for name, of in value.items():
                    yield f"{place} {name}"
                    yield from properties(of, f"{place} {name}")
            else:
                yield from properties(value, place)


def rows(kind: str, file: str, pattern: str) -> Iterator[str]:
    found = re.findall(pattern, (root / file).read_text(), re.M)
    assert found, f"{file}: nothing like {pattern}"
    return (f"{kind} {name}" for name in found)


names = {*options(), *fields(), *properties(json.loads(output(programs / "physvib", "study", "schema")), "protocol"),
         *rows("column", "Source/Scene/EventColumns.h", r'^    \{"(\w+)",\s+\w+Column'), *rows("message", "Source/Live/Messages/MessageRouter.h", r'^    \{"(\w+)",'),
         *rows("argument", "Source/Live/Messages/MessageRouter.h", r'MessageArgument(?: \w+)?\{\s*"(\w+)"'),
         *rows("parameter", "Plugin/Parameters.h", r'\{Parameter::\w+,\s*"(\w+)"')}
promised = {f"{kind} {name}" for line in listed.read_text().splitlines() for kind, last in [line.split(": ")] for name in last.split()}
if "--update" in sys.argv:  # a line per command, structure or kind
    lines: dict[str, list[str]] = {}
    for name in sorted(promised | names):
        kind, last = name.rsplit(" ", 1)
        lines.setdefault(kind, []).append(last)
    listed.write_text("".join(f"{kind}: {' '.join(last)}\n" for kind, last in lines.items()))
if gone := sorted(promised - names):
    sys.exit("promised, and gone (Docs/stable.md):\n" + "\n".join(gone))
