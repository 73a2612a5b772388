"""Converts scenes and strokes from the forms that users pass."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Callable, Mapping
from typing import Any, Union

import numpy as np
import numpy.typing as npt

from . import _sandstroke as _core

Array = npt.ArrayLike
SceneLike = Union[str, "os.PathLike[str]", Mapping[str, Any], "Scene"]
StrokeLike = Union[str, "os.PathLike[str]", npt.ArrayLike, Mapping[str, Any]]


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
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{key} = {_toml(inner)}" for key, inner in value.items()) + "}"
    shown = repr(value)
    shown = shown if len(shown) <= 80 else shown[:77] + "..."
    raise _core.InputError(
        f"{shown} is not a value for a scene; give a number, a string, True or False, or a list of them")


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
    flat = [item for some in settings if some for item in _flat(some).items()]
    unset = [f"!{key}" for key, value in flat if value is None]
    return unset + [f"{key}={_toml(value)}" for key, value in flat if value is not None]


class Scene:
    """All settings of a run: a TOML file or text of several lines, or a mapping such as {"bed": {"cells": [300, 200]}}.
    {"stone": [{"centre": [0, 0, 0]}]} is a scene with a stone.

    settings: other values for keys, as {"relaxation.talus_angle": 34}; None takes a key or a section out. A setting that
    makes another choice, as {"tool.shape": "plate"}, leaves out what the scene sets for the old one, and a UserWarning
    says so. `sandstroke help scene` lists the keys.
    Files in a mapping or text are relative to the current folder. scene["relaxation.talus_angle"] is a value, in the
    text's own types.
    """

    def __init__(self, scene: SceneLike = {}, settings: Mapping[str, Any] | None = None) -> None:
        if isinstance(scene, Scene):
            self._here: _core._Scene = _core._scene_of_text(scene.text, scene._here.folder, [], _overrides(settings))
        elif isinstance(scene, Mapping):
            self._here = _core._scene_of_text("", os.getcwd(), _overrides(scene), _overrides(settings))
        elif isinstance(scene, str) and "\n" in scene:
            self._here = _core._scene_of_text(scene, os.getcwd(), [], _overrides(settings))
        elif isinstance(scene, (str, os.PathLike)):
            self._here = _core._scene_of_file(os.fspath(scene), _overrides(settings))
        else:
            raise _core.InputError(f"scene: give a TOML file, a mapping or a Scene, not {type(scene).__name__}")

    @classmethod
    def _of(cls, here: _core._Scene) -> Scene:
        scene = cls.__new__(cls)
        scene._here = here
        return scene

    @property
    def text(self) -> str:
        """Every setting, as TOML."""
        return self._here.text

    def to_dict(self) -> dict[str, Any]:
        """Every setting: {"bed": {"size": [0.3, 0.2], ...}, ...}."""
        if sys.version_info >= (3, 11):
            import tomllib
        else:
            import tomli as tomllib  # the same, for older Pythons

        return tomllib.loads(self.text)

    def __getitem__(self, key: str) -> Any:
        value: Any = self.to_dict()
        for part in key.split("."):
            if isinstance(value, list) and part.isdecimal() and 0 < int(part) <= len(value):
                value = value[int(part) - 1]  # stone.1.radius
            elif isinstance(value, Mapping) and part in value:
                value = value[part]
            else:
                raise KeyError(key)
        return value

    def __reduce__(self) -> tuple[Callable[[str, str], Scene], tuple[str, str]]:
        return _scene_again, (self.text, os.fspath(self._here.folder))

    def __repr__(self) -> str:
        return f"<sandstroke.Scene of {len(self.text.splitlines())} lines; print(scene.text) shows them>"


def _scene_again(text: str, folder: str) -> Scene:
    return Scene._of(_core._scene_of_text(text, folder, [], []))


Laws = Mapping[str, Callable[..., Any]]
"""Laws of your own, for trying out: "relaxation", "displacement" and "force", each a function.

relaxation(heights, walls, **numbers): changes heights [m] in place, except cells marked in walls; may return the number
of passes.
displacement(heights, underside, motion, **numbers): gets the cells around the tool. Takes out the sand above the tool's
underside [m] (inf beside the tool), and puts it elsewhere in heights. motion [m]: the tool's in the tick.
force(depth, motion, tip, **numbers): returns the force on the tool [N], three numbers. depth [m]: depth of the tool's
lowest point below the level around it.

numbers: cell_size [m], talus_slope, tolerance, radius [m], servo_rate [Hz], parameters (model.parameters).
A run fails if a law makes or loses sand, or returns NaN or infinity.
"""


IN_ARRAYS = "<arrays>"  # the file name in a scene of a stroke that is in no file


def is_masked(values: Any) -> bool:
    """True if a value is masked."""
    look: Callable[[Any], bool] = np.ma.is_masked  # which has no types in numpy 1.24
    return look(values)


def pen_states(pen_down: Any) -> npt.NDArray[np.uint8]:
    """1 where a value counts as true, as in an `if`, else 0."""
    states = np.asarray(pen_down)
    if is_masked(pen_down):
        raise _core.InputError("stroke: pen_down has masked values; fill them, or leave these samples out")
    if states.dtype.kind not in "biufO" or (states.dtype.kind == "f" and np.isnan(states).any()):
        raise _core.InputError("stroke: pen_down must be true or false, or numbers; 0 is false")
    return states.astype(bool).astype(np.uint8)


def stroke_columns(stroke: Any) -> dict[str, Any]:
    """The columns of a stroke: an array of time [s], x, y, z [m], a table with these names, or a mapping of arrays."""
    if isinstance(stroke, Mapping):
        columns = dict(stroke)
        if "pen_down" in columns:
            columns["contact"] = pen_states(columns.pop("pen_down"))
        return columns
    if hasattr(stroke, "columns"):  # a DataFrame; the order of its columns does not matter
        missing = [name for name in ("time", "x", "y", "z") if name not in stroke.columns]
        if missing:
            raise _core.InputError(f"stroke: a table needs the columns time, x, y and z; {', '.join(missing)} is missing")
        return {"time": np.asarray(stroke["time"]), "position": np.asarray(stroke[["x", "y", "z"]])}
    table = np.asanyarray(stroke)  # keeps a mask, which is refused
    if table.dtype.kind not in "fiu" or table.ndim != 2 or table.shape[1] != 4:
        raise _core.InputError(
            f"stroke: an array has the columns time, x, y and z; this one has the shape {table.shape}; for more "
            "columns give {'time': ..., 'position': ..., 'orientation': ...}")
    return {"time": table[:, 0], "position": table[:, 1:]}


def with_stroke(scene: SceneLike, stroke: StrokeLike | None, settings: Mapping[str, Any] | None) -> tuple[_core._Scene, dict[str, Any] | None]:
    """The scene that plays the stroke, and its samples if they are not in a file."""
    if stroke is None:
        whole = Scene(scene, settings)
        if f'file = "{IN_ARRAYS}"' in whole.text:
            raise _core.InputError("the scene's stroke was given as arrays, which it does not keep; give them again")
        return whole._here, None
    if isinstance(stroke, (str, os.PathLike)):
        file = os.path.abspath(os.fspath(stroke))
        return Scene(scene, {"stroke.file": file, **(settings or {})})._here, None
    return Scene(scene, {"stroke.file": IN_ARRAYS, **(settings or {})})._here, stroke_columns(stroke)


def check_laws(laws: Laws) -> dict[str, Callable[..., Any]]:
    """The laws as a dict. The extension module checks names and functions."""
    if not isinstance(laws, Mapping):
        raise _core.InputError('laws: give {"relaxation": f}, {"displacement": f} or {"force": f}, or several of them')
    return dict(laws)


def with_laws(here: _core._Scene, laws: Laws | None) -> _core._Scene:
    """The scene with the user's laws."""
    return here if laws is None else _core._with_laws(here, check_laws(laws))
