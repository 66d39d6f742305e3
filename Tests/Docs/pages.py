#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What people read is whole: pages.py ROOT [PHYSVIB [--update]]. Every page of Docs stands on exactly one shelf of Docs/README.md, has at most 1,500 words
(those of long-pages.txt: at most as many as it says; a decision 220, CHANGELOG 1,500), no placeholder and no dead link; README has at most 100 lines; programs shown in pages are those
that are compiled. With PHYSVIB, the program: every call of it in a page names a command and options that exist, Docs/render.md has every option of `render`, and
Docs/commands.md is what the program writes of itself (--update writes it). Prints what is wrong; exit code 1 if anything is."""
import re
import subprocess
import sys
import tempfile
from functools import lru_cache
from pathlib import Path

root = Path(sys.argv[1]).resolve()
docs = root / "Docs"
pages = sorted([*docs.glob("*.md"), *docs.glob("tutorials/*.md")])
front = [root / name for name in ("README.md", "CONTRIBUTING.md", "SECURITY.md")]
bad = []


def expect(holds: bool, words: str) -> None:
    if not holds:
        bad.append(words)


def name_of(path: Path) -> str:
    return path.relative_to(root).as_posix()


def blocks(text: str):
    """(info, body) of each fenced block, and of indented ones with the info "indented"."""
    inside, body = None, []
    for line in text.split("\n"):
        fence = line.startswith("```")
        if inside is None and fence:
            inside, body = line[3:].strip(), []
        elif inside is not None and fence:
            yield inside, "\n".join(body)
            inside = None
        elif inside is not None:
            body.append(line)
        elif line.startswith("    "):
            yield "indented", line.strip()


def check_shelves() -> None:
    shelf, places = "", {}
    for line in (docs / "README.md").read_text().split("\n"):
        title = re.match(r"\*\*(.+)\*\*$", line)
        shelf = title[1] if title else shelf
        item = re.match(r"- \[[^]]+\]\(([^)#]+)\)", line)
        if item:
            places.setdefault((docs / item[1]).resolve(), []).append(shelf)
    for page in pages:
        if page.name != "README.md":
            on = places.get(page, [])
            expect(len(on) == 1, f"{name_of(page)}: expected on one shelf of Docs/README.md, found on {len(on)} {on or ''}")


def check_length() -> None:
    allowed = {}
    for line in (root / "Tests/Docs/long-pages.txt").read_text().split("\n"):
        if line and not line.startswith("#"):
            allowed[line.split()[0]] = int(line.split()[1])
    for page in pages:
        words, most = sum(1 for word in page.read_text().split() if re.search(r"\w", word)), allowed.pop(name_of(page), 1500)
        if "<!-- Generated: " in page.read_text():  # a table to search in
            continue
        expect(words <= most, f"{name_of(page)}: expected at most {most} words, found {words}")
        expect(most == 1500 or words > 1500, f"Tests/Docs/long-pages.txt: {name_of(page)} has {words} words and needs no line any more")
    expect(not allowed, f"Tests/Docs/long-pages.txt: no such page: {', '.join(allowed)}")
    expect(len(pages) <= 60, f"Docs: expected at most 60 pages, found {len(pages)}")
    everything = sum(len(page.read_text().split()) for page in pages)  # marks of tables included
    expect(everything <= 60000, f"Docs: expected at most 60,000 words on all pages, found {everything}")
    decisions = sorted((docs / "decisions").glob("*.md"))
    expect(len(decisions) <= 100, f"Docs/decisions: expected at most 100 records, found {len(decisions)}: drop those that no longer hold")
    for page, most in [*((record, 220) for record in decisions), (root / "CHANGELOG.md", 1500)]:
        words = sum(1 for word in page.read_text().split() if re.search(r"\w", word))
        expect(words <= most, f"{name_of(page)}: expected at most {most} words, found {words}")
    lines = (root / "README.md").read_text().count("\n")
    expect(lines <= 100, f"README.md: expected at most 100 lines, found {lines}")


def check_text(page: Path) -> None:
    text = page.read_text()
    for number, line in enumerate(text.split("\n"), 1):
        for mark in re.findall(r"@[A-Z][A-Z_]{2,}@", line):
            expect(False, f"{name_of(page)}:{number}: the placeholder {mark}")
    prose = re.sub(r"```.*?```|`[^`\n]*`", "", text, flags=re.S)
    for target in re.findall(r"\]\(([^)\s]+)\)", prose):
        path, _, anchor = target.partition("#")
        if re.match(r"[a-z]+:", target):
            continue
        to = (page.parent / path).resolve() if path else page
        expect(to.exists(), f"{name_of(page)}: {target}: there is no such file")
        if anchor and to.suffix == ".md" and to.exists():
            expect(anchor in anchors(to), f"{name_of(page)}: {target}: there is no such heading")


@lru_cache(None)
def anchors(page: Path) -> set:
    titles = re.findall(r"^#{1,6} (.*)$", re.sub(r"```.*?```", "", page.read_text(), flags=re.S), re.M)
    plain = (re.sub(r"\[([^]]*)\]\([^)]*\)|[`*]", r"\1", title) for title in titles)
    return {re.sub(r"[^\w\- ]", "", title.strip().lower()).replace(" ", "-") for title in plain}


def check_programs() -> None:
    """The text of a block is that of the file, without the line of its licence."""
    example = (root / "Tests/Example/impacts.cpp").read_text().split("\n", 1)[1].rstrip("\n")
    page = "Docs/tutorials/first-game.md"
    expect(("cpp main.cpp", example) in list(blocks((root / page).read_text())), f"{page}: expected a block with all of Tests/Example/impacts.cpp after its first line")


@lru_cache(None)
def help_of(program: str, words: tuple) -> str:
    run = subprocess.run([program, *words, "--help"], capture_output=True, encoding="utf-8")
    return run.stdout if run.returncode == 0 else ""


def check_calls(page: Path, program: str) -> None:
    text = page.read_text()
    for info, body in blocks(text):
        if not (info == "indented" or info.split()[:1] in (["sh"], [])):
            continue
        for line in re.sub(r"\\\n\s*", " ", body).split("\n"):
            for call in re.findall(r"(?:^|[|(;] ?)(?:build/release/bin/)?physvib +([^|;>#)&]*)", re.sub(r"'[^']*'|\"[^\"]*\"", "TEXT", line.strip())):
                check_call(page, program, call.split())


def check_call(page: Path, program: str, words: list) -> None:
    if not words or not re.fullmatch(r"[a-z-]+", words[0]) or words[0].startswith("-"):
        return
    inner = tuple(words[:1])
    own = help_of(program, inner)
    expect(bool(own), f"{name_of(page)}: physvib {' '.join(words[:3])}: there is no such command")
    for word in words[1:]:
        if re.fullmatch(r"[a-z][a-z-]*", word) and re.search(rf"^\s+{word}\b", own, re.M):
            deeper = help_of(program, inner + (word,))
            own += deeper
    for option in re.findall(r"(?<![\w-])--[a-z][a-z0-9-]*", " ".join(words)):
        expect(re.search(rf"{option}(?![\w-])", own) is not None, f"{name_of(page)}: physvib {words[0]}: there is no option {option}")


def check_options(program: str) -> None:
    """The page of render's options has all of them."""
    page = (docs / "render.md").read_text()
    for option in re.findall(r"^\s+(?:-\w,)?(--[a-z-]+)", help_of(program, ("render",)), re.M):
        expect(option == "--help" or re.search(rf"{option}(?![\w-])", page) is not None, f"Docs/render.md: not a word of {option}")


def check_commands(program: str) -> None:
    """The page of all commands is generated."""
    page = docs / "commands.md"
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, "--reference", folder], check=True)
        written = (Path(folder) / "md/physvib.md").read_text()
    if "--update" in sys.argv:
        page.write_text(written)
    expect(page.read_text() == written, "Docs/commands.md: expected what the program writes: Tests/Docs/pages.py . PHYSVIB --update")


check_shelves()
check_length()
if len(sys.argv) > 2:
    check_commands(sys.argv[2])
    check_options(sys.argv[2])
for page in [*front, *pages]:
    check_text(page)
    if len(sys.argv) > 2:
        check_calls(page, sys.argv[2])
check_programs()
if bad:
    sys.exit("\n".join(bad))
print(f"{len(pages) + len(front)} pages: nothing missing")
