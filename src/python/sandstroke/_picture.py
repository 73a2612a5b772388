"""Pictures of sand."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _sandstroke as _core
from ._arguments import Array, Scene, SceneLike
from ._run import Run


def render(sand: Run | Array, scene: SceneLike | None = None, *, start: Array | None = None,
           floor: Array | None = None, tool: Sequence[float] | None = None, orientation: Sequence[float] = (0.0, 0.0, 0.0, 1.0),
           **view: Any) -> npt.NDArray[np.uint8]:
    """A picture of a run's end, or of heights [m], as an array of 8 bits: (height, width, 3).

    scene: the scene of these heights; default: the run's. start: heights at the start [m], which determine camera and
    colours; default: the run's. floor [m], not-a-number where there is none: stones and the bottom of the bed, which
    are drawn where they are bare; default: the run's. tool: position of the tip [m], to draw the tool; orientation: the hand's (x, y, z, w).
    view: keys of the scene's [view]: name="top", style="height" or "difference", azimuth, elevation [deg], size=(w, h).
    """
    if isinstance(sand, Run):
        scene = sand.scene if scene is None else scene
        start = sand.initial if start is None else start
        floor = sand.floor if floor is None else floor
        sand = sand.final
    elif scene is None:
        raise _core.InputError("render: heights need their scene; give scene=...")
    settings: Mapping[str, Any] = {f"view.{key}": value for key, value in view.items()}
    here = Scene(scene, settings)._here
    place = None if tool is None else tuple(float(x) for x in tool)
    return _core._picture(here, sand, sand if start is None else start, place, tuple(float(x) for x in orientation),
                          floor)
