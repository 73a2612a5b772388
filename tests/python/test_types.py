"""The package and the code of the notebooks are clean under `mypy --strict`; the stub has what the extension module has."""
import ast
import importlib.metadata
import json
import os
import subprocess
import sys

import pytest

import sandstroke
from conftest import SOURCE, needs
from sandstroke import _sandstroke

PYTHON = SOURCE / "src/python"
STUB = ast.parse((PYTHON / "sandstroke/_sandstroke.pyi").read_text())
UNTYPED = "[mypy-matplotlib.*,scipy.*,xarray.*]\nignore_missing_imports = True\n"  # or without types in some versions


def complaints(folder, *arguments):
    """What `mypy --strict` finds; empty: nothing."""
    needs("xarray")
    needs("mypy")
    if importlib.metadata.version("mypy").split(".")[:2] != ["1", "0"]:
        pytest.skip("the types were checked with mypy 1.0, of Debian 12; others may find other things in numpy's stubs")
    (folder / "mypy.ini").write_text("[mypy]\n" + UNTYPED)
    ended = subprocess.run(
        [sys.executable, "-m", "mypy", "--strict", "--config-file", "mypy.ini", "--cache-dir", "../mypy", *arguments],  # for all tests
        cwd=folder, env={**os.environ, "MYPYPATH": str(PYTHON)}, capture_output=True, text=True)
    return "" if ended.returncode == 0 else ended.stdout + ended.stderr


def test_the_package_is_clean(tmp_path):
    assert complaints(tmp_path, "-p", "sandstroke") == ""


def test_the_code_of_the_notebooks_is_clean(tmp_path):
    files = []
    for path in sorted((PYTHON / "notebooks").glob("*.ipynb")):
        code = ["".join(cell["source"]) for cell in json.loads(path.read_text())["cells"] if cell["cell_type"] == "code"]
        files.append(f"{path.stem}.py")
        (tmp_path / files[-1]).write_text("\n\n".join(code) + "\n")
    assert len(files) == 4
    assert complaints(tmp_path, *files) == ""


def in_stub(statements):
    """The statements that define something, by its name."""
    return {one.target.id if isinstance(one, ast.AnnAssign) else one.name: one for one in statements
            if isinstance(one, (ast.AnnAssign, ast.ClassDef, ast.FunctionDef))}


def own(thing):
    return {name for name in vars(thing) if not name.startswith(("__", "_pybind11_"))}


def arguments(function):
    """Every argument's name, if callers can use it, and whether it has a default."""
    args = function.args
    names = [None] * len(args.posonlyargs) + [one.arg for one in args.args]
    names = [None if name == "self" or str(name).startswith("arg") else name for name in names]
    defaults = [False] * (len(names) - len(args.defaults)) + [True] * len(args.defaults)
    return names, defaults, [one.arg for one in args.kwonlyargs], [one is not None for one in args.kw_defaults]


def check_function(stub, real):
    first = real.__doc__.splitlines()[0]  # pybind11 writes: tick(self: ..., position: object, ...) -> ...
    assert arguments(stub) == arguments(ast.parse(f"def {first}: ...").body[0]), first


def test_the_stub_has_the_names_and_arguments_of_the_module():
    stub = in_stub(STUB.body)
    assert set(stub) == own(_sandstroke)
    for name, one in stub.items():
        real = getattr(_sandstroke, name)
        if isinstance(one, ast.FunctionDef):
            check_function(one, real)
        elif isinstance(one, ast.ClassDef) and name != "ResultWarning":
            members = in_stub(one.body)
            assert set(members) - {"__init__"} == own(real), name
            assert not one.bases or [base.id for base in one.bases] == [base.__name__ for base in real.__bases__]
            for member, function in members.items():
                is_property = any(decorator.id == "property" for decorator in function.decorator_list)
                assert is_property == isinstance(vars(real)[member], property), member
                if not is_property:
                    check_function(function, getattr(real, member))


def test_the_stub_has_what_a_warning_has(small, line):
    with pytest.warns(sandstroke.ResultWarning) as told:
        sandstroke.run(small, line, settings={"relaxation.max_passes": 3})
    assert set(in_stub(in_stub(STUB.body)["ResultWarning"].body)) == set(vars(told[0].message))
