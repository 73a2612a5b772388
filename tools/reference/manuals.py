"""Pages on commands and keys, from the manual pages that the program prints (sandstroke help --man [TOPIC]).

Manual pages mark what is a name, a value and an example; tables on a terminal do not.
"""

from __future__ import annotations

import html
import re
import subprocess
from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import groupby


@dataclass
class Part:
    """A part of a section: a paragraph, lines as they are, or an entry, which has a head."""

    text: str = ""
    head: str = ""
    preformatted: bool = False

    def name(self) -> str:
        """The head up to the end of its bold or slanted letters."""
        return plain(self.head.split("\\fR")[0])

    def rest(self) -> str:
        return plain(self.head.partition("\\fR")[2])

    def value_and_unit(self) -> tuple[str, str]:
        """What stands behind a key: " = VALUE UNIT"."""
        found = re.fullmatch(r'(?: = ("[^"]*"|\[.*\]|\S+))? *(.*)', self.rest())
        assert found
        return found[1] or "", found[2]


@dataclass
class Section:
    title: str
    parts: list[Part] = field(default_factory=list)


def plain(roff: str) -> str:
    """Text without roff's escapes."""
    return re.sub(r"\\(f[BIR]|.)", lambda found: {"-": "-", "e": "\\"}.get(found[1], ""), roff)


def sections_of(manual: str) -> list[Section]:
    sections = [Section("")]
    lines = iter(manual.splitlines())
    for line in lines:
        request, _, argument = line.partition(" ")
        parts = sections[-1].parts
        if request in (".SH", ".SS"):
            sections.append(Section(argument))
        elif request == ".TP":
            parts.append(Part(head=next(lines)))
        elif request == ".PP":
            parts.append(Part())
        elif request == ".nf":
            kept = iter(lambda: next(lines), ".fi")
            parts.append(Part("\n".join(map(plain, kept)), preformatted=True))
        elif request in (".B", ".I", ".BR", ".TH"):
            parts.append(Part(plain(argument)))
        else:
            if not parts or parts[-1].preformatted:
                parts.append(Part())
            parts[-1].text += (" " if parts[-1].text else "") + plain(line)
    return sections


def manual(program: str, *topic: str) -> str:
    return subprocess.run([program, "help", "--man", *topic], check=True, text=True, stdout=subprocess.PIPE).stdout


def topics(program: str) -> list[str]:
    """The topics of sandstroke help: what the manual page says under SEE ALSO."""
    seen = sections_of(manual(program))[-1]
    return [part.text.split()[0].removeprefix("sandstroke-") for part in seen.parts]


def raw(lines: list[str]) -> list[str]:
    """HTML that Doxygen passes on as it is."""
    return ["", "@htmlonly", *lines, "@endhtmlonly", ""]


def heading(page: str, title: str) -> list[str]:
    """A section of a page, as Doxygen lists it in the page's contents."""
    anchor = re.sub(r"[^\w-]+", "-", f"{page}-{title}").strip("-")
    return ["", f"@section {anchor} " + re.sub(r"[\[\]]", r"\\\g<0>", title)]


def section_html(section: Section, table: str, row: Callable[[Part], str]) -> list[str]:
    """A section's paragraphs. Its entries are rows of tables of a class."""
    lines: list[str] = []
    for are_entries, parts in groupby(section.parts, lambda part: part.head != ""):
        if are_entries:
            lines += [f'<table class="entries {table}">', *map(row, parts), "</table>"]
        else:
            lines += [f"<pre>{html.escape(part.text)}</pre>" if part.preformatted else f"<p>{html.escape(part.text)}</p>"
                      for part in parts if part.text]
    return lines


def row_html(anchor: str, *cells: str) -> str:
    return f'<tr id="{html.escape(anchor)}">' + "".join(f"<td>{cell}</td>" for cell in cells) + "</tr>"


def code(text: str) -> str:
    return f"<code>{html.escape(text)}</code>" if text else ""


def commands_page(program: str) -> str:
    """Every command with its options."""
    lines = ["# Commands {#commands}", "", "[TOC]"]
    for section in sections_of(manual(program)):
        command, _, usage = plain(section.title).partition(" [")
        if command in ("", "NAME", "SYNOPSIS", "COMMANDS", "SEE ALSO"):
            continue

        def row(part: Part, scope: str = command.removeprefix("sandstroke ").replace(" ", "-")) -> str:
            name = part.name()
            anchor = f"{scope}-{name.rpartition(',')[2].strip('-')}"
            return row_html(anchor, code(name) + html.escape(part.rest()), html.escape(part.text))

        lines += heading("commands", command if usage else command.capitalize())
        lines += raw(([f"<pre>{html.escape(f'{command} [{usage}')}</pre>"] if usage else []) +
                     section_html(section, "options", row))
    return "\n".join(lines)


def topic_page(program: str, topic: str) -> str:
    """The keys of a file that people write, the metrics or the warnings."""
    sections = [section for section in sections_of(manual(program, topic)) if section.title not in ("", "SEE ALSO")]
    used = [any(values) for values in zip(*(part.value_and_unit() for section in sections for part in section.parts
                                            if part.head))]

    def row(part: Part) -> str:
        value, unit = part.value_and_unit()
        shown = [cell for cell, is_used in zip((code(value), html.escape(unit)), used) if is_used]
        return row_html(part.name(), code(part.name()), *shown, html.escape(part.text))

    lines = [f"# {topic.capitalize()} {{#keys-{topic}}}", "", "[TOC]"]
    for section in sections:
        title = plain(section.title)
        if title == "NAME":
            summary = section.parts[0].text.partition(" - ")[2]
            section.parts[0].text = f"{summary[0].upper()}{summary[1:]}."
        elif title != "DESCRIPTION":
            lines += heading(f"keys-{topic}", title)
        lines += raw(section_html(section, "keys", row))
    return "\n".join(lines)
