"""Sand that is sculpted with a haptic device: simulate strokes, step a device through sand, draw and compare.

    import sandstroke
    run = sandstroke.run("scene.toml", settings={"relaxation.talus_angle": 34})
    run.final                  # heights [m], a NumPy array of rows (along y) and columns (along x)
    run.trace["device_force"]  # on the hand in every tick [N]

run, read, compare and render are functions; Simulation is a device that is stepped tick by tick, step_many steps many at once. All numbers are in SI units. The results have the same bits as those of the command `sandstroke run`.
"""

try:
    from . import _sandstroke
except ImportError as error:
    from ._build import check_python
    check_python(error)
    raise
from ._arguments import Laws, Scene, SceneLike, StrokeLike
from ._judging import bench, stress
from ._picture import render
from ._run import Comparison, Run, compare, read, run
from ._sandstroke import Error, FileError, InputError, ResultWarning, Tick, UnstableError
from ._simulation import Simulation, Ticks, step_many

__version__ = _sandstroke.version

__all__ = [
    "Comparison", "Error", "FileError", "InputError", "Laws", "ResultWarning", "Run", "Scene", "SceneLike", "Simulation", "StrokeLike", "Tick",
    "Ticks", "UnstableError", "bench", "compare", "read", "render", "run", "step_many", "stress",
]
