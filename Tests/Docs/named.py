#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What a page names is there: named.py ROOT. In README, CONTRIBUTING, SECURITY and Docs, decisions apart: paths of the source, headers, CMake options, environment variables,
programs, link targets, options of the command line, and identifiers of C. Prints each that is not, with its page; exit code 1 if any is."""
import re
import shutil
import subprocess
import sys
from pathlib import Path

root = Path(sys.argv[1]).resolve()
names = ([name for name in subprocess.run(["git", "-C", str(root), "ls-files"], capture_output=True, encoding="utf-8").stdout.split("\n") if name] if shutil.which("git") else []) or \
        [path.relative_to(root).as_posix() for path in root.rglob("*") if path.is_file() and path.relative_to(root).parts[0] not in ("build", "out", ".git")]
tops = {name.split("/")[0] for name in names}
pages = [name for name in names if re.fullmatch(r"(README|CONTRIBUTING|SECURITY|Docs/[\w-]+|Docs/tutorials/[\w-]+)\.md", name) and (root / name).exists()]


def text_of(name):
    try:
        return (root / name).read_text(encoding="utf-8")
    except (UnicodeDecodeError, FileNotFoundError):
        return ""


sources = {name: text_of(name) for name in names if not name.endswith((".md", ".png", ".webp"))}
told = "\n".join(sources.values())
words = set(re.findall(r"[A-Za-z_][A-Za-z0-9_]*", told))
options = set(re.findall(r"--[a-z][a-z0-9-]*", told + text_of("Docs/commands.md"))) | {"--" + word for word in re.findall(r'"([a-z][a-z0-9-]+)(?:,\w)?"', told)}
dashed = set(re.findall(r"[a-z0-9]+(?:-[a-z0-9]+)+", told))
dashed |= {f"physvib-{name.split('/')[1].lower()}-tests" for name in names if re.match(r"Tests/\w+/", name)}
dashed |= {f"physvib-fuzz-{name.split('/')[2].removesuffix('Fuzz.cpp').lower()}" for name in names if re.fullmatch(r"Tests/Fuzz/\w+Fuzz\.cpp", name)}
tests = {f"{suite}.{name}" for suite, name in re.findall(r"TEST(?:_F|_P)?\(\s*(\w+),\s*(\w+)\)", told)} | set(re.findall(r"\bNAME ([\w.]+)", told))
suites = {name.partition(".")[0] for name in tests}


def is_there(code):
    """Whether what stands between backticks is, or names, something of the source; None: it is of no kind that one can look up."""
    if re.search(r"NAME|Name", code):  # the reader's own
        return None
    path = re.fullmatch(r"(?:\.\./|\./)*([\w.-]+(?:/[\w.+-]+)*)/?(?: .*)?", code)
    if path and path[1].split("/")[0] in tops and "/" in path[1] and path[1].split("/")[0] != "build":
        return (root / path[1]).exists() or any(name.startswith(path[1]) for name in names)
    header = re.fullmatch(r"(?:#include )?<physvib/([\w/]+\.h)>", code)
    if header:
        return any(name.endswith("/" + header[1]) for name in names)
    if re.fullmatch(r"-?-?D?(PHYSVIB_[A-Z0-9_]+)(=.*)?", code):
        return re.search(r"PHYSVIB_[A-Z0-9_]+", code)[0] in words
    if re.fullmatch(r"--[a-z][a-z0-9-]*", code):
        return code in options
    if re.fullmatch(r"(lib)?physvib(-[a-z0-9]+)+", code):
        return code in dashed or code.removeprefix("lib") in dashed
    if re.fullmatch(r"physvib_[a-z0-9_]+(\(.*\))?", code):
        return code.partition("(")[0] in words
    if re.fullmatch(r"PhysVib::\w+", code):
        return code.removeprefix("PhysVib::") in words
    if re.fullmatch(r"[A-Z]\w+\.[A-Z]\w{7,}", code):
        return code in tests if code.partition(".")[0] in suites else None
    return None


bad, looked = [], 0
for page in pages:
    text = re.sub(r"^```.*?^```", "", text_of(page), flags=re.S | re.M)
    for code in sorted(set(re.findall(r"`([^`\n]+)`", text))):
        there = is_there(code)
        looked += there is not None
        if there is False:
            bad.append(f"{page}: `{code}`: there is nothing of that name")
if bad:
    sys.exit("\n".join(bad))
print(f"{len(pages)} pages: {looked} names, each of something that is there")
