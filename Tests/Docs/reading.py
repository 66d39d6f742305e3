#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""How easily the pages read: reading.py ROOT [COMMIT]. SCOWL, where the package `scowl` is not installed, names its folder. Of README, CONTRIBUTING and Docs (decision records apart), as they are or as they were at a commit of git: words, mean words
of a sentence, share of sentences over 25 words, and Flesch's reading ease (206.835 - 1.015 words per sentence - 84.6 syllables per word; 60 and more is plain English, 30 and less
hard; technical terms cost points). The words of the old idiom (Tests/House/old-words.md) in 1,000, and the share of words that are neither among the 4,400 commonest of English (SCOWL's
size 10, with plurals and the like) nor in the glossary, with those met most often. Then the ten hardest sentences. Code, tables, headings and links' targets are not counted. A figure to compare with itself, not a test."""
import collections
import os
import re
import subprocess
import sys
from pathlib import Path

root, commit = Path(sys.argv[1]), sys.argv[2] if len(sys.argv) > 2 else ""


def git(*words):
    return subprocess.run(["git", "-C", str(root), *words], capture_output=True, check=True, encoding="utf-8").stdout


def pages():
    names = git("ls-tree", "-r", "--name-only", commit).split("\n") if commit else [path.relative_to(root).as_posix() for path in root.glob("**/*.md")]
    for name in sorted(names):
        if re.fullmatch(r"(README|CONTRIBUTING|Docs/[\w-]+|Docs/tutorials/[\w-]+)\.md", name):
            yield name, git("show", f"{commit}:{name}") if commit else (root / name).read_text()


def sentences(text):
    text = re.sub(r"<!--.*?-->|^```.*?^```|^(?:    |#|\||!).*?$", "\n\n", text, flags=re.S | re.M)
    text = re.sub(r"!?\[([^]]*)\]\([^)]*\)", r"\1", text)
    text = re.sub(r"`[^`]*`", "code", text)
    for paragraph in re.split(r"\n\s*\n|\n(?=\s*(?:-|\d+\.) )", text):
        words = " ".join(re.sub(r"^\s*(?:-|\d+\.) |[*_]", "", paragraph).split())
        for sentence in re.split(r"(?<=[.!?])\s+(?=[A-Z(\"])", words):
            if len(re.findall(r"[A-Za-z]{2,}", sentence)) >= 3:
                yield sentence


def syllables(word):
    word = re.sub(r"e$|es$|ed$", "", word.lower())
    return max(1, len(re.findall(r"[aeiouy]+", word)))


def ease(words, count):
    return 206.835 - 1.015 * len(words) / count - 84.6 * sum(map(syllables, words)) / len(words)


def line(name, parts):
    words = [word for sentence in parts for word in re.findall(r"[A-Za-z']+", sentence)]
    long = sum(1 for sentence in parts if len(sentence.split()) > 25)
    return f"{name:44} {len(words):6} words {len(words) / len(parts):6.1f} a sentence {100 * long / len(parts):5.1f} % long, ease {ease(words, len(parts)):5.1f}"


def old_words():
    """As one expression."""
    table = (root / "Tests/House/old-words.md").read_text()
    return re.compile("|".join(f"(?:{row})" for row in re.findall(r"^\| `(.+?)` \|", table, re.M)).replace("\\|", "|"), re.I)


def common():
    """The commonest words of English and those of the glossary; none if the list is not there."""
    folder = Path(os.environ.get("SCOWL", "/usr/share/dict/scowl"))
    lists = [folder / f"{kind}-words.10" for kind in ("english", "british", "american")]
    if not all(path.exists() for path in lists):
        return set()
    glossary = re.findall(r"[a-z]+", (root / "Docs/glossary.md").read_text().lower())
    return {word for path in lists for word in path.read_text(encoding="latin-1").lower().split()} | set(glossary)


def stems(word):
    """The word, and what it may be a plural, a past, a participle or an adverb of."""
    yield word
    for ending, instead in (("'s", ""), ("s", ""), ("es", ""), ("ies", "y"), ("ed", ""), ("ed", "e"), ("ing", ""), ("ing", "e"), ("ly", ""), ("er", ""), ("er", "e")):
        if word.endswith(ending):
            yield word[: len(word) - len(ending)] + instead
    if re.search(r"(.)\1(ed|ing)$", word):
        yield re.sub(r"(.)\1(ed|ing)$", r"\1", word)


def rare(sentences_of_all):
    known = common()
    words = [word for sentence in sentences_of_all for word in re.findall(r"[a-z]{3,}(?:'[a-z]+)?", sentence.lower())]
    return words, collections.Counter(word for word in words if known and not any(stem in known for stem in stems(word)))


everything = []
for name, text in pages():
    parts = list(sentences(text))
    everything += [(sentence, name) for sentence in parts]
    if parts:
        print(line(name, parts))
print(line("all", [sentence for sentence, _ in everything]))
idiom = sum(len(old_words().findall(sentence)) for sentence, name in everything if name != "Docs/glossary.md")
print(f"words of the old idiom: {1000 * idiom / sum(len(sentence.split()) for sentence, _ in everything):.2f} in 1,000")
words, unknown = rare(sentence for sentence, _ in everything)
if common():
    print(f"words beyond the commonest and the glossary: {100 * sum(unknown.values()) / len(words):.1f} %; most often: {', '.join(word for word, _ in unknown.most_common(30))}")
else:
    print("words beyond the commonest: expected the lists of the package scowl, or their folder in SCOWL")
print("\nHardest sentences:")
hardest = sorted((part for part in everything if len(part[0].split()) >= 12), key=lambda part: ease(re.findall(r"[A-Za-z']+", part[0]), 1))
for sentence, name in hardest[:10]:
    print(f"- {name}: {sentence}")
