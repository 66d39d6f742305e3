#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Words of the old idiom in what people read: words.py ROOT [--list] [--update].

The words stand in old-words.md beside this script; words.txt says how many of them a file may still have. A file with more fails, and so does
one that has fewer than its line says: lower the number, so that it cannot grow again. --update writes the list; --list prints each word with its place. Comments and
identifiers are read in the modules of COMMENTED only, identifiers word by word."""
import re
import sys
from pathlib import Path

root = Path(sys.argv[1]).resolve()
allowed_file = Path(__file__).with_name("words.txt")
COMMENTED = ("Source/Core", "Source/Contacts", "Source/Live/Session")
HEAD = "# How many words of the old idiom (old-words.md) a file may still have. Numbers only go down: Tests/House/words.py ROOT --update.\n"


def old_words():
    """(expression, what to write instead) of each row."""
    text = Path(__file__).with_name("old-words.md").read_text()
    for row in re.findall(r"^\| `(.+?)` \| (.+?) \|$", text, re.M):
        yield re.compile(row[0].replace("\\|", "|"), re.I), row[1]


def sentences(line):
    """The string literals of a line that are more than a name, without the options and fields that they name."""
    for text in re.findall(r'"((?:[^"\\]|\\.)*)"', line):
        if " " in text:
            yield re.sub(r'--[\w-]+|\\"\w+\\"', " ", text)


def comment(line):
    """The comment of a line of C++, without the code that it quotes."""
    text = re.sub(r'"(?:[^"\\]|\\.)*"', '""', line).partition("//")[2]
    return re.sub(r"`[^`]*`", " ", text)


def names(line):
    """The identifiers of a line of C++ in words, a full stop behind each: maxEnchanters is "max enchanters." """
    code = re.sub(r'"(?:[^"\\]|\\.)*"', "", line).partition("//")[0]
    return " ".join(" ".join(re.findall(r"[A-Z]?[a-z]+", name)) + "." for name in re.findall(r"[A-Za-z_]\w+", code))


def read_line(line, is_whole):
    """What people read of a line of C++; `is_whole`: comments and identifiers too."""
    text = "" if re.match(r"\s*(//|#include)", line) else " ".join(sentences(line))
    return " ".join((text, comment(line), names(line))) if is_whole else text


def sources():
    """(path, text) of what people read: pages, help texts and error lines. Of C++, the string literals, and in some modules the comments."""
    pages = [*(root / name for name in ("README.md", "CONTRIBUTING.md", "SECURITY.md")), *sorted((root / "Docs").glob("**/*.md"))]
    for page in pages:
        if page.name != "glossary.md":
            written = page.read_text()
            if page.parent.name == "decisions":  # records of what was thought; their titles stand in lists
                written = next(line for line in written.split("\n") if line.startswith("# "))
            prose = re.sub(r"^```.*?^```$", lambda m: "\n" * m[0].count("\n"), written, flags=re.S | re.M)
            yield page, re.sub(r"`[^`\n]*`|\]\([^)]*\)|^    .*$", " ", prose, flags=re.M)
    for folder in ("Source", "Standalone", "Plugin"):
        for file in sorted([*(root / folder).glob("**/*.cpp"), *(root / folder).glob("**/*.h")]):
            is_whole = file.relative_to(root).as_posix().startswith(tuple(module + "/" for module in COMMENTED))
            yield file, "\n".join(read_line(line, is_whole) for line in file.read_text().split("\n"))


def main():
    words, found = list(old_words()), {}
    for path, text in sources():
        name = path.relative_to(root).as_posix()
        for expression, instead in words:
            for hit in expression.finditer(text):
                found.setdefault(name, []).append((text.count("\n", 0, hit.start()) + 1, hit[0], instead))
    if "--list" in sys.argv:
        for name, hits in sorted(found.items()):
            for line, word, instead in sorted(hits):
                print(f"{name}:{line}: {word}  ->  {instead}")
    if "--update" in sys.argv:
        allowed_file.write_text(HEAD + "".join(f"{name} {len(hits)}\n" for name, hits in sorted(found.items())))
    allowed = dict((line.split()[0], int(line.split()[1])) for line in allowed_file.read_text().split("\n") if line and not line.startswith("#"))
    bad = []
    for name in sorted({*found, *allowed}):
        have, may = len(found.get(name, [])), allowed.get(name, 0)
        if have > may:
            shown = ", ".join(f"line {line}: {word}" for line, word, _ in sorted(found[name])[:3])
            bad.append(f"{name}: expected at most {may} words of the old idiom, found {have} ({shown}...)")
        elif have < may:
            bad.append(f"Tests/House/words.txt: {name} has {have}, its line says {may}: lower it")
    if bad:
        sys.exit("\n".join(bad))
    print(f"{sum(len(hits) for hits in found.values())} words of the old idiom in {len(found)} files; none more than before")


main()
