"""The program: `python -m sandstroke run scene.toml` is `sandstroke run scene.toml`."""

from __future__ import annotations

import os
import sys
import sysconfig
from pathlib import Path

here = Path(__file__).resolve().parent
# The nearest one: in a build folder, or under the prefix in which the module is installed.
places = [here.parents[1], *(parent / "bin" for parent in here.parents), Path(sysconfig.get_path("scripts"))]
for place in places:
    program = place / "sandstroke"
    if program.is_file() and os.access(program, os.X_OK):
        os.execv(program, ["sandstroke", *sys.argv[1:]])
sys.exit("python -m sandstroke: the program is not installed with the module, in none of: " + ", ".join(map(str, places)))
