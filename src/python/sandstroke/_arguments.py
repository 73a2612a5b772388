"""Scenes and strokes, in the forms in which people have them."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Mapping
from typing import Any, Union

import numpy as np

from . import _sandstroke as _core

SceneLike = Union[str, "os.PathLike[str]", Mapping[str, Any], "Scene"]
StrokeLike = Union[str, "os.PathLike[str]", np.ndarray, Mapping[str, Any]]


def _toml(value: Any) -> str:
    """A value as TOML text."""
    if isinstance(value, np.ndarray) or isinstance(value, np.generic):
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, (str, os.PathLike)):
        return json.dumps(os.fspath(value), ensure_ascii=False)
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(_toml, value)) + "]"
    raise _core.InputError(f"{value!r} is no value of a scene; give a number, a text, True or False, or a list of them")


def _flat(settings: Mapping[str, Any], prefix: str = "") -> dict[str, Any]:
    """{"tool": {"radius": 1}} and {"tool.radius": 1} are the same."""
    flat: dict[str, Any] = {}
    for key, value in settings.items():
        if isinstance(value, Mapping):
            flat.update(_flat(value, f"{prefix}{key}."))
        else:
            flat[f"{prefix}{key}"] = value
    return flat


def _overrides(*settings: Mapping[str, Any] | None) -> list[str]:
    return [f"{key}={_toml(value)}" for some in settings if some for key, value in _flat(some).items()]


class Scene:
    """All settings of a run: a TOML file or text, or a mapping such as {"bed": {"cells": [300, 200]}}.

    settings: other values for keys, as {"relaxation.talus_angle": 34}. `sandstroke help scene` lists the keys.
    Files in a mapping are relative to the current folder.
    """

    def __init__(self, scene: SceneLike = {}, settings: Mapping[str, Any] | None = None) -> None:
        if isinstance(scene, Scene):
            self._here = _core._scene_of_text(scene.text, scene._here.folder, _overrides(settings))
        elif isinstance(scene, Mapping):
            # The model's preset is given first, for it sets what other keys then change.
            given = _flat(scene)
            self._here = _core._scene_of_text("", os.getcwd(), _overrides(given, settings))
        else:
            self._here = _core._scene_of_file(os.fspath(scene), _overrides(settings))

    @property
    def text(self) -> str:
        """Every setting, as TOML."""
        return self._here.text

    def __repr__(self) -> str:
        return f"<sandstroke.Scene of {len(self.text.splitlines())} lines; print(scene.text) shows them>"


Laws = Mapping[str, Callable[..., Any]]
"""Laws of your own, for trying out: "relaxation", "displacement" and "force", each a function.

relaxation(heights, walls, **numbers): changes heights [m] in place, but no cell that walls marks; may return how many
passes it took.
displacement(heights, underside, motion, **numbers): of the cells around the tool; takes out what stands above the tool's
underside [m] (inf beside it), and puts it elsewhere in heights; motion [m] is that of the tool in the tick.
force(depth, motion, tip, **numbers): returns the force on the tool [N], three numbers; depth [m] is that of its lowest
point below the level around it.

numbers: cell_size [m], talus_slope, tolerance, radius [m], servo_rate [Hz], parameters (model.parameters).
A run fails where a law makes or loses sand, or gives what is not a number.
"""


def stroke_columns(stroke: np.ndarray | Mapping[str, Any]) -> dict[str, Any]:
    """Of an array of time [s], x, y, z [m] in four columns, or a mapping of arrays by name."""
    if isinstance(stroke, Mapping):
        columns = dict(stroke)
        if "pen_down" in columns:
            columns["contact"] = np.asarray(columns.pop("pen_down"), dtype=np.uint8)
        return columns
    table = np.asarray(stroke)
    if table.dtype.kind not in "fiu" or table.ndim != 2 or table.shape[1] != 4:
        raise _core.InputError(f"stroke: an array has the columns time, x, y and z; this one has the shape {table.shape}")
    return {"time": table[:, 0], "position": table[:, 1:]}


def with_stroke(scene: SceneLike, stroke: StrokeLike | None, settings: Mapping[str, Any] | None) -> tuple[Any, Any]:
    """The scene that plays the stroke, and its samples where these are not in a file."""
    if stroke is None:
        return Scene(scene, settings)._here, None
    if isinstance(stroke, (str, os.PathLike)):
        file = os.path.abspath(os.fspath(stroke))
        return Scene(scene, {"stroke.file": file, **(settings or {})})._here, None
    return Scene(scene, {"stroke.file": "stroke", **(settings or {})})._here, stroke_columns(stroke)
