"""Runs a scene, reads a run file, and compares two runs."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np
import numpy.typing as npt

from . import _sandstroke as _core
from ._arguments import Array, Laws, Scene, SceneLike, StrokeLike, with_laws, with_stroke

if TYPE_CHECKING:
    import xarray


class Run:
    """The results of a run. Its arrays are read only and not copies."""

    def __init__(self, kept: _core._Run) -> None:
        self._kept = kept

    @property
    def final(self) -> npt.NDArray[np.float64]:
        """Heights at the end [m]: rows along y, columns along x."""
        return self._kept.final

    @property
    def initial(self) -> npt.NDArray[np.float64]:
        """Heights at the start [m], as final."""
        return self._kept.initial

    @property
    def floor(self) -> npt.NDArray[np.float64] | None:
        """Floor under the sand [m], as final: stones, or the bottom of the bed. NaN where there is none; None without any."""
        return self._kept.floor

    @property
    def x(self) -> npt.NDArray[np.float64]:
        """Centres of the columns [m]."""
        return self._kept.x

    @property
    def y(self) -> npt.NDArray[np.float64]:
        """Centres of the rows [m]."""
        return self._kept.y

    @property
    def cell_size(self) -> float:
        """Width of a cell [m]."""
        return self._kept.cell_size

    @property
    def frames(self) -> npt.NDArray[np.float64]:
        """Heights during the run [m], if output.frames is set: (frame, row, column)."""
        return self._kept.frames

    @property
    def frame_times(self) -> npt.NDArray[np.float64]:
        """Times of the frames [s]."""
        return self._kept.frame_times

    @cached_property
    def trace(self) -> dict[str, npt.NDArray[Any]]:
        """Every tick, by name: time [s], device_force [N] (n, 3), depth [m], torque [N m], contact ...

        `to_xarray("trace")` has the same with units and meanings.
        """
        return {name: array for name, _, _, array, _ in self._kept.trace_columns()}

    @cached_property
    def relaxations(self) -> dict[str, npt.NDArray[Any]]:
        """Every relaxation, by name: time [s], passes, residual, moved_volume [m^3]."""
        return {name: array for name, _, _, array, _ in self._kept.relaxation_columns()}

    @cached_property
    def summary(self) -> dict[str, Any]:
        """The output of `sandstroke run --json`. Of a run that was read from a file: what the file tells of it."""
        summary: dict[str, Any] = json.loads(self._kept.summary)
        return summary or {}

    @property
    def scene(self) -> Scene:
        """All settings of the run."""
        return Scene._of(self._kept.scene)

    @property
    def path(self) -> str | None:
        """Path of the run's file, or None."""
        return self._kept.path or None

    def __reduce__(self) -> Any:
        raise TypeError("a Run cannot be sent between processes; return its arrays (run.final) or run.to_xarray()")

    def to_xarray(self, group: Literal["surface", "trace", "relaxation"] = "surface") -> xarray.Dataset:
        """As xarray opens that group of the run file: "surface", "trace" or "relaxation"."""
        import xarray

        if group == "surface":
            axes = {
                "y": ("y", self.y, {"units": "m", "long_name": "centre of a row of cells"}),
                "x": ("x", self.x, {"units": "m", "long_name": "centre of a column of cells"}),
            }
            heights: dict[str, tuple[tuple[str, ...], npt.NDArray[np.float64], dict[str, str]]] = {
                "initial": (("y", "x"), self.initial, {"units": "m", "long_name": "height of the sand at the start"}),
                "final": (("y", "x"), self.final, {"units": "m", "long_name": "height of the sand at the end"}),
            }
            if self.floor is not None:
                heights["floor"] = (("y", "x"), self.floor, {
                    "units": "m", "long_name": "height of the floor under the sand; not-a-number: there is none"})
            if len(self.frame_times):
                axes["time"] = ("time", self.frame_times, {"units": "s", "long_name": "time of a frame"})
                heights["frames"] = (("time", "y", "x"), self.frames,
                                     {"units": "m", "long_name": "height of the sand over time"})
            return xarray.Dataset(heights, axes, {"cell_size": self.cell_size})
        if group not in ("trace", "relaxation"):
            raise _core.InputError(f"'{group}' is not a group of a run; the groups are surface, trace and relaxation")
        if group == "trace" and not self.trace:
            raise _core.InputError("the run kept no trace; it has no stroke, or output.trace is false")
        columns = self._kept.trace_columns() if group == "trace" else self._kept.relaxation_columns()
        variables: dict[str, Any] = {}
        for name, units, meaning, array, components in columns:
            attributes = {"units": units, "long_name": meaning} if units else {"long_name": meaning}
            over = ("time",) if not components else ("time", "component" if len(components) == 4 else "axis")
            if components:
                variables.setdefault(over[1], (over[1], np.array(list(components), dtype=object)))
            variables[name] = (over, array, attributes)
        data = xarray.Dataset(variables)
        return data.set_coords([name for name in ("time", "axis", "component") if name in data])

    def __repr__(self) -> str:
        rows, columns = self.final.shape
        return f"<sandstroke.Run: {rows} x {columns} cells, {len(self.trace.get('time', ()))} ticks>"


def run(scene: SceneLike, stroke: StrokeLike | None = None, *, settings: Mapping[str, Any] | None = None,
        surface: Array | None = None, output: str | os.PathLike[str] | None = None, threads: int = 0,
        laws: Laws | None = None) -> Run:
    """Plays a stroke through the sand of a scene, and lets the sand come to rest.

    scene: a TOML file, a mapping, or a Scene. stroke, instead of the scene's: a file, an array of time [s], x, y, z
    [m] in four columns, or a mapping of "time" (n,) and "position" (n, 3), and perhaps "velocity", "force" (n, 3),
    "orientation" (n, 4: x, y, z, w), "pressure" and "pen_down" (n,). Samples more than 0.1 s apart, or five times
    the usual spacing if that is more, are not joined: the tool is lifted between them ("gap_threshold" [s] in a mapping
    changes that). settings: other values for keys of the
    scene, as {"relaxation.talus_angle": 34}. surface: heights to start from [m], (rows, columns) of the bed, instead of
    the scene's; the first row has the smallest y, and no cell may be masked or nan. output: also write the run file
    (.h5). threads: 0 is all cores; the result does not depend on it.

    laws: functions of your own, slow, for trying out: "relaxation", "displacement", "force".
      relaxation(heights, walls, **numbers) changes heights [m], (row along y, column along x), in place, except cells
        marked in walls; returns nothing, or the number of passes.
      displacement(heights, underside, motion, **numbers) does the same with the cells around the tool: it puts the sand
        above the tool's underside [m; inf beside the tool] elsewhere in heights.
      force(depth, motion, tip, **numbers) returns the force on the tool [N], three numbers, before the device's limit.
        It is called in ticks in which the tool touches sand.
      depth [m]: depth of the tool's lowest point below the level around it. motion [m]: the tool's motion on the bed
        since the last tick; motion * servo_rate is its velocity. tip [m]: the tip's position on the bed. numbers:
        cell_size [m], talus_slope, tolerance, radius [m], servo_rate [Hz], parameters (model.parameters).

    Lets other Python threads run meanwhile; Ctrl-C ends it.
    """
    here, samples = with_stroke(scene, stroke, settings)
    return Run(_core._run(with_laws(here, laws), samples, surface, "" if output is None else os.fspath(output), threads))


def read(path: str | os.PathLike[str]) -> Run:
    """A run file (.h5)."""
    return Run(_core._read(os.fspath(path)))


class Check(NamedTuple):
    """One check of a comparison. measured and limit are in `unit`; None: there is no number."""

    name: str
    passed: bool
    measured: float | None
    limit: float | None
    unit: str
    sentence: str


class Comparison(NamedTuple):
    """passed: true if all checks passed."""

    passed: bool
    checks: list[Check]

    def __bool__(self) -> bool:
        return self.passed


def compare(golden: str | os.PathLike[str] | Run, other: str | os.PathLike[str] | Run, *, coarsen: bool = False,
            **tolerances: float) -> Comparison:
    """Compares two runs, as `sandstroke compare` does. Takes files, or runs that have a file.

    tolerances: height [m], force [N], depth [m]. coarsen: average the finer bed over the cells of the coarser one.
    """
    paths = []
    for one in (golden, other):
        path = one.path if isinstance(one, Run) else one
        if path is None:
            raise _core.InputError("a run that is compared needs a file; give run(..., output='run.h5')")
        paths.append(os.fspath(path))
    found = json.loads(_core._compare(paths[0], paths[1], tolerances, coarsen))
    checks = [Check(**{name: check[name] for name in Check._fields}) for check in found["checks"]]
    return Comparison(found["passed"], checks)
