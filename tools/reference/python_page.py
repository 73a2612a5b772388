"""The page on the Python module: its public names with their signatures and docstrings."""

from __future__ import annotations

import ast
import html
import importlib
import inspect
import re
import sys
import textwrap
from functools import cached_property
from types import ModuleType
from typing import Any

from manuals import raw


class Words(str):
    """An annotation as it is written, without quotes."""

    __repr__ = str.__str__


def words(annotation: Any) -> Any:
    return Words(annotation) if isinstance(annotation, str) else annotation


def load(folder: str) -> ModuleType:
    sys.path.insert(0, folder)
    return importlib.import_module("sandstroke")


def signature_of(name: str, function: Any, returns: bool = True) -> str:
    signature = inspect.signature(function)
    parameters = [parameter.replace(annotation=words(parameter.annotation))
                  for parameter in signature.parameters.values() if parameter.name not in ("self", "cls")]
    returned = words(signature.return_annotation) if returns else inspect.Signature.empty
    return name + str(signature.replace(parameters=parameters, return_annotation=returned))


def doc_html(thing: Any) -> list[str]:
    """The docstring: paragraphs, and what is indented as it is."""
    lines = []
    for paragraph in re.split(r"\n\s*\n", inspect.getdoc(thing) or ""):
        text = re.sub("`([^`]+)`", r"<code>\1</code>", html.escape(textwrap.dedent(paragraph)))
        lines.append(f"<pre>{text}</pre>" if re.search("^ ", paragraph, re.MULTILINE) else f"<p>{text}</p>")
    return lines


def public_members(owner: type) -> dict[str, Any]:
    """What a class defines, in its order. A field without a value is the text of its type."""
    annotations = vars(owner).get("__annotations__", {})
    fields = vars(owner) | {name: getattr(kind, "__forward_arg__", kind) for name, kind in annotations.items()}
    return {name: member for name, member in fields.items() if not name.startswith("_")}


def member_html(scope: str, name: str, member: Any) -> list[str]:
    if isinstance(member, str):
        shown, docs = f"{name}: {member}", []
    elif isinstance(member, (property, cached_property)):
        getter = member.fget if isinstance(member, property) else member.func
        kind = getattr(getter, "__annotations__", {}).get("return")
        shown, docs = name + (f": {kind}" if kind else ""), doc_html(member)
    else:
        function = getattr(member, "__func__", member)  # of a class method
        shown, docs = signature_of(name, function), doc_html(function)
    return [f'<h3 id="{scope}.{name}"><code>{html.escape(shown)}</code></h3>', *docs]


def class_html(name: str, owner: type) -> list[str]:
    shown = f"class {name}"
    if issubclass(owner, Exception):
        shown += f"({', '.join(base.__name__ for base in owner.__bases__)})"
    elif inspect.isfunction(owner.__init__) and "_core." not in (made := signature_of(name, owner, returns=False)):
        shown = made  # others are made by the module itself
    lines = [f"<pre>{html.escape(shown)}</pre>", *(doc_html(owner) if owner.__doc__ else [])]
    for member_name, member in public_members(owner).items():
        lines += member_html(f"sandstroke.{name}", member_name, member)
    return lines


def alias_html(module: ModuleType, name: str) -> list[str]:
    """A name for types, as the module's source defines it."""
    for part in vars(module).values():
        if not inspect.ismodule(part) or not part.__name__.startswith(module.__name__) or not str(part.__file__).endswith(".py"):
            continue
        for node in ast.parse(inspect.getsource(part)).body:
            if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == name:
                return [f"<pre>{html.escape(ast.unparse(node))}</pre>"]
    raise SystemExit(f"reference: sandstroke.{name} is no function, no class, and no name for types")


def python_page(module: ModuleType) -> str:
    lines = ["# Python {#python-reference}", "", "[TOC]", *raw(doc_html(module))]
    for name in sorted(module.__all__, key=lambda name: (not name.islower(), name.lower())):  # functions first
        public = getattr(module, name)
        lines += ["", f"@section python-{name} {name}"]
        if inspect.isclass(public):
            shown = class_html(name, public)
        elif inspect.isroutine(public):
            shown = [f"<pre>{html.escape(signature_of(name, public))}</pre>", *doc_html(public)]
        else:
            shown = alias_html(module, name)
        lines += raw(shown)
    return "\n".join(lines)
