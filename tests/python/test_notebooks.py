"""The notebooks run, from their first cell to their last, and draw what they are kept with."""
import pathlib

import pytest

from conftest import SOURCE, needs

NOTEBOOKS = sorted((SOURCE / "src/python/notebooks").glob("*.ipynb"))


def pictures(notebook):
    return sum("image/png" in output.get("data", {}) for cell in notebook.cells for output in cell.get("outputs", []))


def test_there_are_four():
    assert [path.stem for path in NOTEBOOKS] == ["control", "first-stroke", "planner", "sweep"]


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_runs(path, tmp_path):
    nbformat, nbclient = needs("nbformat"), needs("nbclient")
    for module in ("ipykernel", "matplotlib", "scipy", "xarray"):
        needs(module)
    kept = nbformat.read(path, 4)
    assert pictures(kept) > 0 and path.stat().st_size < 250_000
    again = nbformat.read(path, 4)
    nbclient.NotebookClient(again, timeout=3000, startup_timeout=600,  # a busy machine starts kernels slowly
                            resources={"metadata": {"path": str(tmp_path)}}).execute()
    assert pictures(again) == pictures(kept)
