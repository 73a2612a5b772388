"""The repository's Markdown pages, in Doxygen's dialect.

GitHub and Doxygen differ in links to pages, headings and files, in pictures of one name, and in what "@" and "#" mean
in a text. Versions of Doxygen differ, too. So links and pictures become HTML here.
"""

from __future__ import annotations

import html
import os
import re
import subprocess
from collections.abc import Iterator
from itertools import groupby
from operator import itemgetter
from pathlib import Path

CODE = re.compile(r"(`+)(.+?)\1", re.DOTALL)
LINK = re.compile(r"(!?)\[((?:[^\[\]]|\[[^\]]*\])*)\]\(([^)\s]+)\)")
PICTURE = re.compile(r'<img src="([^"]+)"')
HEADING = re.compile("^(#+) (.*)$", re.MULTILINE)
FENCE = re.compile(r" *```")
ITEM = re.compile(r"(\d+)\. +")
SHOWN_BY_BROWSERS = (".png", ".txt")


def page_name(page: str) -> str:
    """README.md: index; src/rules/README.md: src-rules; CHANGELOG.md: changelog."""
    folder, file = os.path.split(page.removesuffix(".md"))
    parts = [*folder.split("/"), *([file.lower()] if file != "README" else [])]
    return "-".join(filter(None, parts)) or "index"


def copy_name(file: str) -> str:
    """Where a file lies beside the pages. Sources end in .txt, so that every browser shows them."""
    return f"files/{file}" + ("" if Path(file).suffix in SHOWN_BY_BROWSERS else ".txt")


def slug(heading: str) -> str:
    """The anchor that GitHub gives to a heading."""
    return re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")


def numbered(lines: list[str]) -> list[str]:
    """Ordered lists as HTML, because Doxygen counts each from 1."""
    shown: list[str] = []
    indent = 0  # of the text of an item; 0: not in a list
    for line in lines:
        item = ITEM.match(line)
        if indent and line and not item and not line.startswith(" "):
            shown += ["</li></ol>", ""]
            indent = 0
        if item:
            shown.append("</li>" if indent else f'<ol start="{item[1]}">')
            indent = item.end()
            line = f"<li>{line[indent:]}"
        shown.append(line[indent:] if indent and not item else line)
    return shown + ["</li></ol>"] * (indent > 0)


def with_fences(lines: list[str]) -> Iterator[tuple[bool, str]]:
    """Whether lines are in a block of code, or at its ends."""
    is_code = False
    for line in lines:
        is_fence = FENCE.match(line) is not None
        yield is_code or is_fence, line
        is_code ^= is_fence


def labelled(page: str, found: re.Match[str], after_title: str) -> str:
    """A heading with the name by which links find it."""
    level, title = found.groups()
    if level == "#":
        return f"# {title} {{#{'mainpage' if page == 'README.md' else page_name(page)}}}\n\n[TOC]\n\n{after_title}"
    return f"{level} {title} {{#{page_name(page)}-{slug(title)}}}"


class Pages:
    """All Markdown pages of the repository. `copied`: the other files to which they link."""

    def __init__(self, source: Path, headers: set[str]) -> None:
        self.source, self.headers = source, headers
        listed = subprocess.run(["git", "ls-files", "*.md"], cwd=source, check=True, text=True, stdout=subprocess.PIPE)
        self.names = listed.stdout.split()
        self.copied: set[str] = set()

    def converted(self, page: str, after_title: str = "") -> str:
        """A page; `after_title` is put below its title."""
        shown = []
        for is_code, lines in groupby(with_fences(numbered((self.source / page).read_text().splitlines())), itemgetter(0)):
            text = "\n".join(line for _, line in lines)
            shown.append(text if is_code else "\n\n".join(self.inline(page, part) for part in text.split("\n\n")))
            shown[-1] = shown[-1] if is_code else HEADING.sub(lambda found: labelled(page, found, after_title), shown[-1])
        return "\n".join(shown) + "\n"

    def inline(self, page: str, text: str) -> str:
        """A paragraph with its links and pictures."""
        kept: list[str] = []

        def keep(shown: str) -> str:
            kept.append(shown)
            return f"\ue000{len(kept) - 1}\ue001"

        text = CODE.sub(lambda found: keep(found[0]), text)
        text = PICTURE.sub(lambda found: keep(f'<img src="{self.target(page, found[1])}"'), text)
        text = LINK.sub(lambda found: keep(self.link(page, *found.groups())), text)
        text = re.sub("@|#(?=\\w)", r"\\\g<0>", text)
        while "\ue000" in text:
            text = re.sub("\ue000(\\d+)\ue001", lambda found: kept[int(found[1])], text)
        return re.sub('@ref [^"]+"[^"]+"', lambda found: found[0].replace("`", ""), text)  # which knows no code

    def link(self, page: str, picture: str, text: str, link: str) -> str:
        if re.match("https?:", link):
            return f'<a href="{html.escape(link)}">{text}</a>'
        if picture:
            return f'<img src="{self.target(page, link)}" alt="{html.escape(text)}">'
        file, _ = self.named(page, link)
        if file in self.headers:  # whose pages Doxygen names
            return f'@ref {file.removeprefix("src/")} "{text}"'
        return f'<a href="{self.target(page, link)}">{text}</a>'

    def named(self, page: str, link: str) -> tuple[str, str]:
        """The file that a link names, from the repository's top, and the heading."""
        path, _, fragment = link.partition("#")
        return os.path.normpath(os.path.join(os.path.dirname(page), path)) if path else page, fragment

    def target(self, page: str, link: str) -> str:
        """Where a link leads in the reference."""
        file, fragment = self.named(page, link)
        if file in self.names:
            return f"{page_name(file)}.html" + (f"#{page_name(file)}-{fragment}" if fragment else "")
        if not (self.source / file).is_file():
            raise SystemExit(f"reference: {page} links to {link}, which is no file")
        self.copied.add(file)
        return copy_name(file)
