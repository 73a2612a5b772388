"""`python -m sandstroke` is the program."""

import subprocess
import sys

from conftest import PROGRAM


def result(*command, folder):
    ended = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    return ended.returncode, ended.stdout, ended.stderr


def test_the_module_is_the_program(tmp_path):
    for arguments in (["--version"], ["help", "scene"], ["run", "nothing.toml"], ["no-command"]):
        assert result(sys.executable, "-m", "sandstroke", *arguments, folder=tmp_path) == result(
            PROGRAM, *arguments, folder=tmp_path), arguments
