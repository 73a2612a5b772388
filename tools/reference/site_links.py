"""What is done with the HTML that Doxygen wrote: its links are checked, and all pages get the search."""

from __future__ import annotations

import json
import re
from html.parser import HTMLParser
from pathlib import Path
from typing import NamedTuple
from urllib.parse import unquote

LOADED = {"script": "src", "img": "src", "link": "href", "iframe": "src", "object": "data"}
TITLES = {"h1", "h2", "h3", "code"}
UNREAD = {"script", "style"}
# Pages that only list names, or repeat a source.
LISTS = re.compile(r"(_source|-members|_8md)$|^(functions|globals|namespacemembers)(_|$)|^dir_|"
                   r"^(annotated|classes|files|hierarchy|namespaces|pages)$")
# Anchors of lists within a page.
LISTED = re.compile("-(attribs|classes|members|methods|types)$")


class Link(NamedTuple):
    target: str
    loaded: bool  # with the page, or followed by a reader


class Part:
    """What follows an anchor: its title is the first heading, or the first code of a table's row."""

    def __init__(self, anchor: str) -> None:
        self.anchor, self.title, self.words = anchor, "", list[str]()


class Page(HTMLParser):
    """A page's anchors and links, and its text in parts."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.text = text
        self.title = ""
        self.anchors: set[str] = set()
        self.links: list[Link] = []
        self.parts = [Part("")]
        self.inside: list[str] = []  # elements that matter to text
        self.has_begun = False
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        given = {name: value or "" for name, value in attrs}
        if anchor := given.get("id") or (given.get("name") if tag == "a" else ""):
            self.anchors.add(anchor)
            if self.has_begun and (tag == "a" or tag in ("tr", "h3") and "class" not in given):
                self.parts.append(Part(anchor))
        if given.get("class") == "contents":
            self.has_begun = True
        loads = tag in LOADED and LOADED[tag] in given
        if loads or "href" in given:
            self.links.append(Link(given[LOADED[tag]] if loads else given["href"], loads))
        if tag in TITLES | UNREAD | {"title"}:
            self.inside.append(tag)

    def handle_endtag(self, tag: str) -> None:
        if self.inside and self.inside[-1] == tag:
            self.inside.pop()

    def handle_data(self, data: str) -> None:
        words = " ".join(data.replace("\u25c6", "").split())  # without the mark before members
        if not words or UNREAD & set(self.inside):
            return
        part = self.parts[-1]
        if "title" in self.inside:
            self.title = words.removeprefix("sandstroke: ")
        elif self.has_begun and not part.title and part.anchor and TITLES & set(self.inside):
            part.title = words
        elif self.has_begun:
            part.words.append(words)


def pages_of(folder: Path) -> dict[str, Page]:
    return {path.name: Page(mended(path.read_text())) for path in sorted(folder.glob("*.html"))}


def mended(text: str) -> str:
    """Without the link above a class to nested classes that the page does not show, as they are private."""
    return text if 'name="nested-classes"' in text else re.sub(r'<a href="#nested-classes">\w+</a> &#124;\s*', "", text)


def check_links(folder: Path, pages: dict[str, Page]) -> tuple[int, list[str]]:
    """The number of links, and a sentence for each that leads nowhere, or loads something from a network."""
    wrong, count = [], 0
    for name, page in pages.items():
        for link in page.links:
            count += 1
            if re.match("[a-z]+:|//", link.target):
                if link.loaded and not link.target.startswith("data:"):
                    wrong.append(f"{name} loads {link.target} from a network")
                continue
            file, _, anchor = unquote(link.target).partition("#")
            file = file.partition("?")[0] or name
            if not (folder / file).is_file():
                wrong.append(f"{name}: {link.target} is not there")
            elif anchor and file in pages and anchor not in pages[file].anchors:
                wrong.append(f"{name}: {file} has no #{anchor}")
    return count, wrong


def add_search(folder: Path, pages: dict[str, Page]) -> None:
    """Writes the list of all parts that search.js looks through, and loads that on every page."""
    entries = []
    for name, page in pages.items():
        if not LISTS.search(name.removesuffix(".html")):
            for part in page.parts:
                text = " ".join(part.words)
                if (part.title or text) and not LISTED.search(part.anchor):
                    title = page.title if part.anchor in ("", "details") else part.title or page.title
                    entries.append([title, page.title, name + (f"#{part.anchor}" if part.anchor else ""), text])
        (folder / name).write_text(page.text.replace("</body>", '<script src="search.js"></script>\n</body>'))
    listed = json.dumps(entries, ensure_ascii=False, separators=(",", ":"))
    (folder / "search-index.js").write_text(f"const searchIndex = {listed};\n")
