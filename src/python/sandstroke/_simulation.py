"""A simulation that the caller steps tick by tick."""

from __future__ import annotations

import copy
import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _sandstroke as _core
from ._arguments import Array, Laws, Scene, SceneLike, is_masked, with_laws
from ._sandstroke import FileError, InputError, Tick


class Simulation:
    """A device whose hand you move, for a controller, an optimiser or a learner.

    scene, settings, surface, laws: as in run(); a stroke of the scene is not played. relaxes: sand relaxes as the
    scene says; with False only when relax() is called (slips: the former name). With the hand of a stroke and its
    velocities, ticks have the bits of run().

        sim = sandstroke.Simulation("scene.toml")
        tick = sim.tick((0.01, 0.0, -0.004))
        tick.force, tick.depth, tick.torque
    """

    def __init__(self, scene: SceneLike = {}, *, settings: Mapping[str, Any] | None = None, relaxes: bool = True,
                 surface: Array | None = None, laws: Laws | None = None, slips: bool | None = None) -> None:
        if slips is not None:
            relaxes = slips
        self._take(_core._Simulation(with_laws(Scene(scene, settings)._here, laws), relaxes, surface))

    def _take(self, stepped: _core._Simulation) -> None:
        self._stepped = stepped
        setattr(self, "tick", stepped.tick)  # type checkers refuse self.tick = ...

    def copy(self) -> Simulation:
        """Returns a copy that goes on by itself, with the same bits: to try something and come back.

        Copies share the sand that none of them changed, so a copy costs what differs. Not with laws of your own.
        """
        copied = type(self).__new__(type(self))
        copied.__dict__.update(self.__dict__)
        copied._take(self._stepped.copy())
        return copied

    def reset(self) -> None:
        """Goes back to where it began: as it was made, or loaded. Not with laws of your own."""
        self._stepped.reset()

    def state(self) -> bytes:
        """Returns all that it takes to go on with the same bits, also in another process: scene, sand, tool, device.

        Only the version of sandstroke that made it reads it. Not with laws of your own.
        """
        return self._stepped.state()

    def set_state(self, state: bytes) -> None:
        """Goes on from a state() of a simulation of the same scene; if it is another's, nothing changes."""
        self._stepped.set_state(state)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes state() to a file. It replaces only another state."""
        self._stepped.save(os.fspath(path))

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Simulation:
        """Returns the simulation that save() wrote. Files that its scene names, but for the surface, must be there."""
        try:
            with open(path, "rb") as file:
                state = file.read()
        except OSError as error:
            raise FileError(f"{os.fspath(path)}: cannot be read ({error.strerror})") from None
        return cls._of_state(state, os.fspath(path))

    @classmethod
    def _of_state(cls, state: bytes, name: str = "the state") -> Simulation:
        simulation = cls.__new__(cls)
        simulation._take(_core._Simulation.from_state(state, name))
        return simulation

    def __reduce__(self) -> tuple[Any, ...]:  # pickle
        return type(self)._of_state, (self.state(),), self._own()

    def __copy__(self) -> Simulation:
        return self.copy()

    def __deepcopy__(self, memo: dict[int, Any]) -> Simulation:
        memo[id(self)] = copied = self.copy()
        copied.__dict__.update(copy.deepcopy(self._own(), memo))
        return copied

    def _own(self) -> dict[str, Any]:
        """Returns what a subclass adds."""
        return {name: own for name, own in self.__dict__.items() if name not in ("_stepped", "tick")}

    def tick(self, position: Array, velocity: Array | None = None, *, down: bool = True,
             orientation: Array | None = None) -> Tick:
        """Moves the hand to this position [m] and computes one tick. The next tick is 1 / device.servo_rate later.

        velocity [m/s]; None: computed from the last tick's position. down: False lifts the tool. orientation: the
        hand's rotation from tool.orientation, a quaternion (x, y, z, w). Beside the bed there is no force.
        """
        raise NotImplementedError  # each instance has its own tick, which saves a call

    def relax(self) -> dict[str, Any]:
        """Relaxes the sand to rest. Returns passes, residual, moved_volume [m^3], converged."""
        return self._stepped.relax()

    def lift(self) -> None:
        """Lifts the tool out of the sand until the next tick."""
        self._stepped.lift()

    @property
    def heights(self) -> npt.NDArray[np.float64]:
        """The sand as it is now [m]: rows along y, columns along x; a copy."""
        return self._stepped.heights

    @property
    def floor(self) -> npt.NDArray[np.float64] | None:
        """Stones and the bottom under the sand [m]; nan where there is nothing. None without any. A copy."""
        return self._stepped.floor

    @property
    def sources(self) -> list[dict[str, float]]:
        """Where the sand of each [[source]] is [kg]: poured, landed, in_air; asked and taken of a sink."""
        return self._stepped.sources

    @property
    def on_tool(self) -> dict[str, float] | None:
        """Sand that the tool carries, and where it came from and went [m^3]; None where it carries none."""
        return self._stepped.on_tool

    def height_at(self, x: float, y: float) -> float:
        """Height of the sand at (x, y) [m]; nan beside the bed."""
        return self._stepped.height_at(x, y)

    @property
    def time(self) -> float:
        """Time of the next tick [s]."""
        return self._stepped.time

    @property
    def volume(self) -> float:
        """Volume of the sand above z = 0, minus the missing volume below [m^3]."""
        return self._stepped.volume

    @property
    def x(self) -> npt.NDArray[np.float64]:
        """Centres of the columns [m]."""
        return self._stepped.x

    @property
    def y(self) -> npt.NDArray[np.float64]:
        """Centres of the rows [m]."""
        return self._stepped.y

    @property
    def scene(self) -> Scene:
        """All its settings."""
        return Scene._of(self._stepped.scene)

    def __repr__(self) -> str:
        return f"<sandstroke.Simulation at {self.time:.4f} s>"


@dataclass(frozen=True)
class Ticks:
    """The ticks of many simulations: arrays (simulation, tick), vectors (simulation, tick, 3). As in Tick."""

    time: npt.NDArray[np.float64]
    force: npt.NDArray[np.float64]
    sand_force: npt.NDArray[np.float64]
    torque: npt.NDArray[np.float64]
    depth: npt.NDArray[np.float64]
    level: npt.NDArray[np.float64]
    contact: npt.NDArray[np.bool_]
    carried: npt.NDArray[np.float64]
    displaced_volume: npt.NDArray[np.float64]
    position: npt.NDArray[np.float64]


def step_many(simulations: Sequence[Simulation], hands: Array, *, velocities: Array | None = None,
              down: Array | bool = True, orientations: Array | None = None, threads: int = 0) -> Ticks:
    """Steps many simulations at once, such as copies of one: simulation i has the hand hands[i, k] [m] in tick k.

    hands: an array (simulations, ticks, 3). velocities [m/s], orientations (4 numbers), down: as in
    Simulation.tick(), for all ticks; an array of one tick or simulation counts for all. threads: 0: all cores. The
    bits are those of tick(). Where a simulation fails, the others go on to the end; then its error is raised.
    """
    filled: Callable[[Array, float], npt.NDArray[Any]] = np.ma.filled  # which has no types in numpy 1.24
    hands = np.asarray(filled(hands, np.nan), dtype=float)
    if hands.ndim != 3 or hands.shape[0] != len(simulations) or hands.shape[2] != 3:
        raise InputError(f"hands: give an array of {len(simulations)} simulations x ticks x 3 numbers, not "
                         f"{' x '.join(map(str, hands.shape))}")
    size = hands.shape[:2]

    def for_all(name: str, given: Array, width: tuple[int, ...], kind: type[bool] | type[float]) -> npt.NDArray[Any]:
        if is_masked(given):
            raise InputError(f"{name}: some of it is masked")
        try:
            return np.broadcast_to(np.asarray(given, dtype=kind), size + width)
        except ValueError:
            raise InputError(f"{name}: does not fit {size[0]} simulations x {size[1]} ticks") from None

    fields = _core._step_many([one._stepped for one in simulations], hands, for_all("down", down, (), bool),
                              None if velocities is None else for_all("velocities", velocities, (3,), float),
                              None if orientations is None else for_all("orientations", orientations, (4,), float),
                              threads)
    return Ticks(**fields)
