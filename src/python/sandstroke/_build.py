"""Which Python the compiled module is for."""

import importlib.machinery
import pathlib
import sys


def check_python(error: ImportError) -> None:
    """Raises a plain sentence in place of the error where there is no module for this Python."""
    folder = pathlib.Path(__file__).parent
    if any((folder / f"_sandstroke{suffix}").exists() for suffix in importlib.machinery.EXTENSION_SUFFIXES):
        return
    built = ", ".join(sorted(file.name for file in folder.glob("_sandstroke*.so")))
    others = f", only {built}" if built else ""
    version = ".".join(map(str, sys.version_info[:2]))
    raise ImportError(f"{folder} has no compiled module for Python {version} ({sys.executable}){others}. Install it with this Python "
                      "(pip install . in a clone), or build for it (cmake -DPython_EXECUTABLE=...)") from error
