#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""CONTRIBUTING.md's table of additions is true: does what its rows say in a clone of the last commit, builds it, and runs every quiet test there.
Only what a row names is touched. Prints each row with its files, then the tests that failed; exit code 1 if one did.
Usage: additions.py FOLDER [ROW...] [-R TESTS]; FOLDER is made, and kept with its build: run again, it begins from the last commit. TESTS: these alone.
"""
import json
import os
import re
import subprocess
import sys

root = os.path.realpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../.."))
folder = os.path.realpath(sys.argv[1])


def text(path):
    with open(os.path.join(folder, path), encoding="utf-8") as file:
        return file.read()


def put(path, content):
    with open(os.path.join(folder, path), "w", encoding="utf-8") as file:
        file.write(content)


def change(path, before, after):
    """The first `before` becomes `after`; a table that has moved is an error, since the row is read by people."""
    old = text(path)
    if before not in old:
        sys.exit(f"additions.py: {path}: expected {before!r}")
    put(path, old.replace(before, after, 1))


def after_line(path, start, line):
    """`line` behind the last line that begins so."""
    lines = text(path).split("\n")
    places = [i for i, each in enumerate(lines) if each.startswith(start)]
    if not places:
        sys.exit(f"additions.py: {path}: no line begins with {start!r}")
    lines.insert(places[-1] + 1, line)
    put(path, "\n".join(lines))


def run(*words):
    subprocess.run(words, cwd=folder, check=True)


def law():
    laws = "Source/Core/PanningLaws.h"
    after_line(laws, "    triangles,", "    squared, ///< (1 - u)^2")
    after_line(laws, '    {PanningLaw::triangles, "triangles"', '    {PanningLaw::squared, "squared", [](double u) noexcept { return (1.0 - u) * (1.0 - u); }},')
    after_line("Docs/panning.md", "| `triangles` |", "| `squared` | (1 - u)^2 | 0.5625 0.2500 0.0625 | falls fastest |")
    after_line("Docs/panning.md", "| `distance` | four |", "| `squared` | four | 0.00 0.00 0.03 0.16 0.50 | 0.41 0.34 0.29 0.26 0.25 | 0.08 0.05 0.03 0.02 0.02 |")
    after_line("Source/Api/C/physvib.h", "#define PHYSVIB_LAW_TRIANGLES", "#define PHYSVIB_LAW_SQUARED 8    /**< of panning: falls fastest */")
    run("python3", "Source/Api/bindings.py")
    change("Source/Api/JavaScript/package/physvib.d.ts", "| 'triangles'", "| 'triangles' | 'squared'")
    change("Docs/web.md", "`distance`, `triangles`", "`distance`, `triangles`, `squared`")
    change("Tests/Calls/RenderWordsTest.cpp", "auto, distance or triangles", "auto, distance, triangles or squared")


def scene():
    drop = json.loads(text("Source/Scene/Scenes/drop.json"))
    put("Source/Scene/Scenes/knock.json", text("Source/Scene/Scenes/drop.json").replace('"name": "drop"', '"name": "knock"', 1).replace(drop["description"], "as drop, under another name", 1))
    change("Plugin/PluginSettings.cpp", 'Drive{"drop", {', 'Drive{"knock", {17.0, 34.0, 38.0, 48.5, 89.3}},\n                                       Drive{"drop", {')


def material():
    table = json.loads(text("Source/Scene/Materials/table-5-1.json"))
    table.update(name="kitchen", source="a trial of this table's row: not measured", materials=[{"name": "pan lid", "density_kg_per_m2": 900, "friction": 0.3, "restitution": 0.5, "frequency_hz": 310, "decay_per_s": 22}])
    put("Source/Scene/Materials/kitchen.json", json.dumps(table, indent=2) + "\n")


def layout():
    presets = "Source/Core/EnchanterLayout.cpp"
    after_line(presets, "constexpr std::array<ActuatorPlace, 4> corners", "constexpr std::array<ActuatorPlace, 5> cross{{{0.0, 1.0}, {1.0, 1.0}, {0.0, 0.0}, {1.0, 0.0}, {0.5, 0.5}}};")
    change(presets, '    Preset{"phone4", phone, corners},', '    Preset{"phone4", phone, corners}, Preset{"phone5", phone, cross},')
    after_line("Docs/panning.md", "| `phone4`, `ring4` |", "| `phone5` | | as `phone4`, and E in the centre |")
    change("Source/Api/JavaScript/package/physvib.d.ts", "| 'phone4'", "| 'phone4' | 'phone5'")
    change("Source/Api/Godot/WorldClasses.cpp", "phone3,phone4,ring4", "phone3,phone4,phone5,ring4")


def command():
    put("Standalone/CommandLine/Measure/KnockCommand.cpp", """// SPDX-License-Identifier: GPL-3.0-or-later
// The command `physvib knock`, which says so.
#include "CommandLine/Command.h"
#include <iostream>

namespace physvib {

Command knockCommand() {
    return {"knock", "say knock", [](OptionTable&) -> std::function<int()> {
                return [] {
                    std::cout << "knock\\n";
                    return exitDone;
                };
            }};
}

} // namespace physvib
""")
    main = "Standalone/CommandLine/Main.cpp"
    change(main, "thesisCommand();", "thesisCommand(), knockCommand();")
    change(main, "thesisCommand};", "thesisCommand,\n    knockCommand};")


def language():
    for name, english in ("aa", "Afar"), ("zz", "Zaza"):
        words = json.loads(text("Source/Lab/Words/ko.json"))
        words.update(name=name, language=english, in_english=english)
        put(f"Source/Lab/Words/{name}.json", json.dumps(words, indent=2, ensure_ascii=False) + "\n")


def page():
    put("Docs/knocking.md", "<!-- SPDX-License-Identifier: MIT -->\n# Knocking\n\nHow to knock: `physvib render drop --out drop.wav` ([render](render.md)).\n")
    after_line("Docs/README.md", "- [Render](render.md)", "- [Knocking](knocking.md): by hand.")
    pages, bound = "Tests/Docs/pages.py", re.search(r"len\(pages\) <= (\d+)", text("Tests/Docs/pages.py"))[1]
    for words in f"len(pages) <= {bound}", f"at most {bound} pages":
        change(pages, words, words.replace(bound, str(int(bound) + 1)))


def raise_limits():
    """Of C++, to what there is now, as the sentence behind the table says."""
    told = subprocess.run(["Tests/House/size.sh", "."], cwd=folder, capture_output=True, text=True).stdout
    for figure, limit in re.findall(r"(\d+) of +(\d+)$", told, re.M):
        if int(figure) > int(limit):
            change("Tests/House/size.sh", f" {limit}\n", f" {figure}\n")


rows = {row.__name__: row for row in (law, scene, material, layout, command, language, page)}
wanted, _, chosen = (" ".join(sys.argv[2:]) + " ").partition("-R ")
wanted = wanted.split() or list(rows)
if not set(wanted) <= set(rows):
    sys.exit(f"additions.py: expected rows of {', '.join(rows)}")
if not os.path.isdir(os.path.join(folder, ".git")):
    subprocess.run(["git", "clone", "-q", root, folder], check=True)
run("git", "fetch", "-q", root, "HEAD")
run("git", "reset", "-q", "--hard", "FETCH_HEAD")
run("git", "clean", "-qfd")
for name in wanted:
    rows[name]()
    run("git", "add", "-A")
    changed = subprocess.run(["git", "diff", "--cached", "--name-only"], cwd=folder, check=True, capture_output=True, text=True).stdout.split()
    # What is sent is formatted before it is: CONTRIBUTING, "Patches".
    sources = [path for path in changed if path.endswith((".cpp", ".h"))]
    if sources:
        run("clang-format-14", "-i", *sources)
    run("git", "-c", "user.name=additions", "-c", "user.email=additions@example.invalid", "commit", "-qam", name)
    print(f"{name}: {len(changed)} files: {' '.join(changed)}", flush=True)
run("sh", "-c", ". .ci/packages.sh && ensure_build_packages $physvib_test_packages && build release all")
# What rows say is to be done with the build, and the sentence behind the table.
if {"scene", "material"} & set(wanted):
    run("cp", "build/release/PhysVib.jucer", ".")
if "scene" in wanted:
    run("Tests/Cross/hashes.sh", "--update", "build/release/bin/physvib-render")
subprocess.run(["python3", "Tests/Docs/pages.py", ".", "build/release/bin/physvib", "--update"], cwd=folder, stdout=subprocess.DEVNULL)
raise_limits()
tests = ["-R", chosen.strip()] if chosen else ["-LE", "live|display"]
told = subprocess.run(["ctest", "--preset", "release", "-j2", *tests], cwd=folder, capture_output=True, text=True)
failed = re.findall(r"^\s*\d+ - (.*) \((?:Failed|Timeout|Not Run|SEGFAULT)\)", told.stdout, re.M)
print("\n".join(told.stdout.split("\n")[-40:]))
sys.exit(1 if failed or told.returncode else 0)
