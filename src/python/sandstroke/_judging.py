"""Tests whether a user's law converges, conserves sand and stays stable."""

from __future__ import annotations

import json
import os
from collections.abc import Sequence
from typing import Any

from . import _sandstroke as _core
from ._arguments import Laws, check_laws


def bench(laws: Laws, folder: str | os.PathLike[str] = "bench", *, parameters: Sequence[float] = (), quick: bool = True,
          problems: Sequence[str] = ()) -> dict[str, Any]:
    """Measures laws of yours (as in run()) on problems with known answers, beside the program's.

    Writes folder/bench.html, a page of errors, orders and times, and gives its data. parameters: up to four numbers,
    as model.parameters. quick=False takes finer grids. problems: names (`sandstroke bench --help`); default:
    those in which such laws take part. A Python law may take minutes.
    """
    page: dict[str, Any] = json.loads(_core._bench(check_laws(laws), _four(parameters), os.fspath(folder), quick, list(problems)))
    return page


def stress(laws: Laws, *, parameters: Sequence[float] = (), quick: bool = True) -> dict[str, Any]:
    """Seeks cases in which laws of yours lose sand, return NaN, or do not end, as `sandstroke stress` does.

    Gives the page's data: "cases" have a verdict and whether it was a surprise.
    """
    page: dict[str, Any] = json.loads(_core._stress(check_laws(laws), _four(parameters), quick))
    return page


def _four(parameters: Sequence[float]) -> list[float]:
    if len(parameters) > 4:
        raise _core.InputError(f"parameters: has {len(parameters)} numbers; a law has four at most")
    return [*map(float, parameters), 0.0, 0.0, 0.0, 0.0][:4]
