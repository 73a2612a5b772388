"""`python -m sandstroke` is the program."""

import pathlib
import shutil
import subprocess
import sys

import sandstroke
from conftest import PROGRAM


def result(*command, folder):
    ended = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    return ended.returncode, ended.stdout, ended.stderr


def test_the_module_is_the_program(tmp_path):
    for arguments in (["--version"], ["help", "scene"], ["run", "nothing.toml"], ["no-command"]):
        assert result(sys.executable, "-m", "sandstroke", *arguments, folder=tmp_path) == result(
            PROGRAM, *arguments, folder=tmp_path), arguments


def test_a_module_for_another_python_is_refused(tmp_path):
    folder = tmp_path / "sandstroke"
    shutil.copytree(pathlib.Path(sandstroke.__file__).parent, folder, ignore=shutil.ignore_patterns("*.so", "__pycache__"))
    (folder / "_sandstroke.cpython-32-x86_64-linux-gnu.so").touch()
    status, _, said = result(sys.executable, "-c", "import sys; sys.path.insert(0, '.'); import sandstroke", folder=tmp_path)
    assert status == 1
    last = said.splitlines()[-1]
    assert f"no compiled module for Python {sys.version_info[0]}.{sys.version_info[1]} ({sys.executable})" in last, said
    assert "only _sandstroke.cpython-32-x86_64-linux-gnu.so." in last, said
