# SPDX-License-Identifier: MIT
# README, CHANGELOG, the pages of Docs and the files they name become a site: same words, same pictures, with a list of pages and a search.
# usage: site.py FOLDER [PAGE]   (from the project's folder; PAGE: the built web page, to be played with on the first screen)
import html
import json
import os
import posixpath
import re
import shutil
import subprocess
import sys

SITE = "Docs/Site"
HOME = "README.md"
DEMO = '<p class="demo"><a href="demo/index.html">Play with it here</a> in the browser, with headphones or without</p>'
LIST = "Docs/README.md"


def text_of(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def pages():
    """Every page: the project's own, Docs, and its decisions."""
    return [HOME, "CHANGELOG.md"] + sorted(posixpath.join(folder, name) for folder in ("Docs", "Docs/decisions") for name in os.listdir(folder) if name.endswith(".md"))


def place_of(path):
    """Where a file of the project is in the site; README begins, files of the source are shown as they are."""
    if path == HOME:
        return "index.html"
    if path.endswith(".md"):
        return ("pages.html" if path == LIST else path.removeprefix("Docs/").removesuffix(".md").lower() + ".html")
    if os.path.isdir(path):
        return path.removeprefix("Docs/") + "/index.html"
    if re.search(r"\.(png|svg|webp)$", path):
        return path.removeprefix("Docs/")
    return "files/" + path + ".html"


def plain(markup):
    return html.unescape(re.sub(r"<[^>]*>", "", markup))


def anchor_of(title, taken):
    """As GitHub makes it, so that links within pages work in both places."""
    name = re.sub(r"[^\w\- ]", "", plain(title).strip().lower()).replace(" ", "-")
    again = sum(1 for other in taken if other == name or re.fullmatch(re.escape(name) + r"-\d+", other))
    return f"{name}-{again}" if again else name


class Page:
    def __init__(self, path):
        self.path, self.place, self.links, self.anchors = path, place_of(path), [], []
        if os.path.isdir(path):
            names = sorted(name for name in os.listdir(path) if not name.startswith("."))
            source = f"# {path}\n\n" + "".join(f"- [{self.title_in(path, name)}]({name})\n" for name in names)
        elif path.endswith(".md"):
            source = text_of(path)
        else:
            source = f"# {path}\n\n<pre><code>{html.escape(text_of(path), quote=False)}</code></pre>\n".replace("\n\n", "\n&#10;").replace("\n&#10;<pre>", "\n\n<pre>", 1)
        self.body = self.linked(self.headed(subprocess.run(["cmark-gfm", "--unsafe", "-e", "table", "-e", "autolink"], input=source, capture_output=True, check=True,
                                                           encoding="utf-8").stdout))
        title = re.search(r"<h1[^>]*>(.*?)</h1>", self.body, re.S)
        self.title = plain(title[1]) if title else path

    @staticmethod
    def title_in(folder, name):
        path = posixpath.join(folder, name)
        return re.search(r"^# (.*)", text_of(path), re.M)[1] if name.endswith(".md") else name

    def headed(self, body):
        def head(found):
            self.anchors.append(anchor_of(found[2], self.anchors))
            return f'<h{found[1]} id="{self.anchors[-1]}">{found[2]}</h{found[1]}>'
        return re.sub(r"<h([1-6])>(.*?)</h\1>", head, body, flags=re.S)

    def linked(self, body):
        folder = self.path if os.path.isdir(self.path) else posixpath.dirname(self.path)

        def link(found):
            target = html.unescape(found[2])
            if re.match(r"[a-z]+:", target):
                return found[0]
            name, _, anchor = target.partition("#")
            path = posixpath.normpath(posixpath.join(folder, name)) if name else self.path
            self.links.append((path, anchor, target))
            if path.startswith("..") or not os.path.exists(path):
                return found[0]
            return f'{found[1]}"{self.to(place_of(path))}{"#" + anchor if anchor else ""}"'
        body = re.sub(r'(<(?:a href|img src)=)"([^"]*)"', link, body)
        return re.sub(r"<table>.*?</table>", r'<div class="wide">\g<0></div>', body, flags=re.S)

    def to(self, place):
        return posixpath.relpath(place, posixpath.dirname(self.place) or ".")

    def sections(self):
        """(title, address, words) of each part, for the search."""
        parts = re.split(r'<h[1-3] id="([^"]*)">(.*?)</h[1-3]>', self.body, flags=re.S)
        for anchor, title, body in zip(parts[1::3], parts[2::3], parts[3::3]):
            name = plain(title)
            yield (name if name == self.title else f"{self.title}: {name}", f"{self.place}#{anchor}", " ".join(plain(body).split()))


def all_pages():
    """The pages, and whatever else of the project they lead to."""
    made, waiting = {}, pages()
    while waiting:
        path = waiting.pop()
        if path in made or re.search(r"\.(png|svg|webp)$", path):
            continue
        made[path] = Page(path)
        waiting += [to for to, _, _ in made[path].links if not to.startswith("..") and os.path.exists(to)]
    return made


def dead_links(made):
    for path, page in sorted(made.items()):
        for to, anchor, written in page.links:
            if to.startswith("..") or not os.path.exists(to):
                yield f"{path}: {written}: there is no such file"
            elif anchor and to in made and anchor not in made[to].anchors:
                yield f"{path}: {written}: there is no such heading"


def contents(made):
    """The list of pages, from where it stands for readers of the source."""
    body = re.sub(r"<h1.*?</h1>\s*<p>.*?</p>", "", made[LIST].body, count=1, flags=re.S)
    found = re.findall(r'<p><strong>(.*?)</strong></p>|<a href="([^"#]*\.html)[^"]*">(.*?)</a>', body, flags=re.S)
    return [("PhysVib", [("index.html", "README"), ("pages.html", "All pages"), ("reference/index.html", "Reference of C and C++"), ("changelog.html", "What changed")])] + \
           [group for group in grouped(found) if group[1]]


def grouped(found):
    groups = []
    for title, place, name in found:
        if title:
            groups.append((plain(title), []))
        elif groups and place not in [p for _, items in groups for p, _ in items]:
            groups[-1][1].append((place, plain(name)[0].upper() + plain(name)[1:]))
    return groups


def first_screen(body):
    """README with a way to the live page above its moving picture, so that both are seen at once."""
    return re.sub(r"(?=<p><img )", DEMO + "\n", body, count=1)


def whole(page, groups, has_demo):
    navigation = ""
    for title, items in groups:
        rows = "".join(f'<li><a href="{page.to(place)}"{" aria-current=page" if place == page.place else ""}>{html.escape(name)}</a></li>' for place, name in items)
        navigation += f"<h2>{html.escape(title)}</h2><ul>{rows}</ul>"
    root = page.to(".")
    return text_of(f"{SITE}/page.html").replace("@TITLE@", html.escape(page.title if page.path == HOME else f"{page.title} · PhysVib")).replace("@ROOT@", root) \
        .replace("@PAGES@", navigation).replace("@BODY@", first_screen(page.body) if has_demo and page.path == HOME else page.body)


def write(path, text):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w", encoding="utf-8", newline="\n") as file:
        file.write(text)


def main(into, demo=None):
    made = all_pages()
    dead = list(dead_links(made))
    if dead:
        sys.exit("\n".join(dead))
    groups = contents(made)
    for page in made.values():
        write(os.path.join(into, page.place), whole(page, groups, demo))
        for to, _, _ in page.links:
            if re.search(r"\.(png|svg|webp)$", to):
                os.makedirs(os.path.dirname(os.path.join(into, place_of(to))), exist_ok=True)
                shutil.copyfile(to, os.path.join(into, place_of(to)))
    parts = [part for path in sorted(made) if path.endswith(".md") for part in made[path].sections()]
    write(os.path.join(into, "words.js"), "words = " + json.dumps(parts, ensure_ascii=False, separators=(",", ":")) + ";\n")
    for name in ("style.css", "search.js"):
        shutil.copyfile(f"{SITE}/{name}", os.path.join(into, name))
    if demo:
        shutil.copytree(demo, os.path.join(into, "demo"), dirs_exist_ok=True)
    print(f"{len(made)} pages, {sum(len(page.links) for page in made.values())} links, none dead")


main(*sys.argv[1:])
