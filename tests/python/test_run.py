"""Runs from Python are those of the command, and wrong input is told as it tells it."""
import gc
import os
import re
import resource
import signal
import subprocess
import sys
import textwrap
import threading
import time
import warnings

import numpy as np
import pytest

import sandstroke
from conftest import PROGRAM, SOURCE, needs


def run_program(*arguments):
    # The module may be run under a sanitizer that is loaded first; the program is not built for it.
    environment = {name: value for name, value in os.environ.items() if name != "LD_PRELOAD"}
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, env=environment)


def test_a_scene_file_gives_the_bits_of_the_command(tmp_path):
    scene = SOURCE / "strokes/weakening/scene.toml"
    assert run_program("run", scene, "-o", tmp_path / "a.h5").returncode == 0
    command = sandstroke.read(tmp_path / "a.h5")
    module = sandstroke.run(scene)
    assert np.array_equal(module.final, command.final)
    assert np.array_equal(module.initial, command.initial)
    assert module.trace.keys() == command.trace.keys()
    for name, column in module.trace.items():
        assert np.array_equal(column, command.trace[name], equal_nan=True), name
    assert module.scene.text == command.scene.text


def test_a_run_that_writes_a_file_writes_that_of_the_command(tmp_path):
    scene = SOURCE / "strokes/weakening/scene.toml"
    run_program("run", scene, "-o", tmp_path / "a.h5")
    run = sandstroke.run(scene, output=tmp_path / "b.h5")
    assert run.path == str(tmp_path / "b.h5")
    assert sandstroke.compare(tmp_path / "a.h5", run).passed
    assert sandstroke.compare(tmp_path / "a.h5", run, height=0.0, force=0.0, depth=0.0)


def test_scenes_are_files_mappings_and_scenes_with_other_settings(small, line):
    flat = {"bed.size": [0.2, 0.12], "bed.cells": np.array([100, 60]), "model.preset": "accurate", "tool.radius": 0.01}
    one, other = sandstroke.run(small, line), sandstroke.run(flat, line)
    assert np.array_equal(one.final, other.final)
    again = sandstroke.run(sandstroke.Scene(small), line)
    assert np.array_equal(one.final, again.final)
    steeper = sandstroke.run(small, line, settings={"relaxation.talus_angle": 40})
    assert steeper.final.max() > one.final.max()  # ramparts stand steeper
    assert "talus_angle = 40" in steeper.scene.text


def test_strokes_are_files_arrays_and_mappings(small, line, tmp_path):
    run = sandstroke.run(small, line)
    assert run.final.min() < -0.002
    assert run.summary["ticks"] == len(run.trace["time"]) == 400
    columns = {"time": line[:, 0], "position": line[:, 1:]}
    assert np.array_equal(sandstroke.run(small, columns).final, run.final)
    # Strides, other orders and types of numbers are all the same.
    assert np.array_equal(sandstroke.run(small, np.asfortranarray(line)).final, run.final)
    assert np.array_equal(sandstroke.run(small, np.repeat(line, 2, axis=0)[::2]).final, run.final)
    np.savetxt(tmp_path / "line.csv", line, delimiter=",", header="time,x,y,z", comments="", fmt="%.17g")
    settings = {"stroke.table.position_unit": "m", "stroke.table.time_unit": "s"}
    assert np.array_equal(sandstroke.run(small, tmp_path / "line.csv", settings=settings).final, run.final)
    # Half of it in the air.
    lifted = sandstroke.run(small, {**columns, "pen_down": line[:, 0] < 0.2})
    assert lifted.summary["contact_ticks"] < 0.6 * run.summary["contact_ticks"]


def test_scenes_are_texts_can_be_read_and_sent(small, line):
    import pickle
    scene = sandstroke.Scene("[bed]\nsize = [0.2, 0.12]\ncells = [100, 60]\n", {"tool.radius": 0.01})
    assert scene["bed.cells"] == [100, 60] and scene["tool.radius"] == 0.01
    assert scene.to_dict()["relaxation"]["talus_angle"] == 30.0
    again = pickle.loads(pickle.dumps(scene))
    assert again.text == scene.text
    assert np.array_equal(sandstroke.run(again, line).final, sandstroke.run(scene, line).final)
    with pytest.raises(KeyError):
        scene["tool.wide"]
    with pytest.raises(sandstroke.InputError, match="given as arrays.*give them again"):
        sandstroke.run(sandstroke.run(small, line).scene)
    with pytest.raises(TypeError, match="return its arrays"):
        pickle.dumps(sandstroke.run(small, line))


def test_scenes_may_have_stones(small):
    import pickle
    stones = [{"centre": [0.0, 0.0, 0.0], "radius": 0.02},
              {"shape": "box", "centre": np.array([0.05, 0.0, 0.0]), "size": [0.02, 0.03, 0.01]}]
    scene = sandstroke.Scene({"bed": {"size": [0.2, 0.12], "cells": [100, 60], "floor": -0.02}, "stone": stones,
                              "sand": {"region": [{"talus_angle": 40.0}]}}, {"stone.1.radius": 0.03})
    assert scene["stone.1.radius"] == 0.03 and scene["stone.2.size"] == [0.02, 0.03, 0.01]
    assert scene["sand.region.1.talus_angle"] == 40.0
    assert len(scene.to_dict()["stone"]) == 2
    for key in ("stone.3.radius", "stone.0.radius", "stone.radius"):
        with pytest.raises(KeyError):
            scene[key]
    simulation = sandstroke.Simulation(scene)
    assert simulation.heights.max() > 0.029  # lifted onto the stone
    assert np.array_equal(pickle.loads(pickle.dumps(simulation)).heights, simulation.heights)
    with pytest.raises(sandstroke.InputError, match="stone.2 lies outside the bed"):
        sandstroke.Scene(scene, {"stone.2.centre": [1.0, 0.0, 0.0]})
    with pytest.raises(sandstroke.InputError, match="a law of your own knows no"):
        sandstroke.Simulation(scene, laws={"force": lambda depth, motion, tip, **numbers: (0.0, 0.0, 0.0)})


def test_scenes_may_have_a_map_of_the_sand(small, tmp_path):
    import pickle
    angles = np.full((60, 100), 25.0)
    angles[:, 50:] = 35.0
    np.save(tmp_path / "talus.npy", angles)
    heap = np.zeros((60, 100))
    heap[20:40, 30:70] = 0.05
    bed = {"bed": {"size": [0.2, 0.12], "cells": [100, 60]}, "relaxation": {"talus_angle": 25.0}}
    seam = {"talus_angle": 35.0, "centre": [0.5, 0.0], "size": [1.0, 1.0]}
    by_map = sandstroke.Scene({**bed, "sand": {"map": {"file": str(tmp_path / "talus.npy")}}})
    by_region = sandstroke.Scene({**bed, "sand": {"region": [seam]}})
    assert by_map["sand.map.file"] == str(tmp_path / "talus.npy")
    run = sandstroke.run(by_map, surface=heap)
    assert np.array_equal(run.final, sandstroke.run(by_region, surface=heap).final)
    assert not np.array_equal(run.final, sandstroke.run(bed, surface=heap).final)
    assert np.array_equal(sandstroke.run(run.scene, surface=heap).final, run.final)
    simulation = sandstroke.Simulation(by_map, surface=heap)
    assert np.array_equal(pickle.loads(pickle.dumps(simulation)).heights, simulation.heights)
    sandstroke.run({**bed, "bed": {"size": [0.2, 0.12], "cells": [50, 30]},
                    "sand": {"map": {"file": str(tmp_path / "talus.npy")}}})
    np.save(tmp_path / "talus.npy", angles + 90.0)
    with pytest.raises(sandstroke.InputError, match="6000 cells have values that are not between 0 and 90"):
        sandstroke.run(by_map, surface=heap)
    with pytest.raises(sandstroke.InputError, match="knows no bed.floor, stone, sand.map"):
        sandstroke.Simulation(by_map, laws={"force": lambda depth, motion, tip, **numbers: (0.0, 0.0, 0.0)})


def test_moist_sand_stands_in_runs_and_simulations():
    import pickle
    cake = {"model": {"preset": "accurate"}, "bed": {"size": [0.2, 0.2], "cells": [100, 100],
            "surface": {"kind": "cylinder", "radius": 0.06, "height": 0.05}}}
    moist = {**cake, "moisture": {"cohesion": 150.0}}
    run = sandstroke.run(moist)
    assert np.array_equal(run.final, run.initial)  # 63 mm would stand
    steepest = lambda heights: np.abs(np.diff(heights, axis=1)).max() / 0.002
    assert steepest(sandstroke.run(cake).final) < 1.0  # as dry sand lies
    # A tool that goes through its edge leaves walls; a pickled copy knows as well what is intact.
    simulation = sandstroke.Simulation(moist)
    for k in range(300):
        simulation.tick((0.04, -0.1 + 0.0005 * k, 0.02))
    other = pickle.loads(pickle.dumps(simulation))
    for k in range(300, 400):
        for one in (simulation, other):
            one.tick((0.04, -0.1 + 0.0005 * k, 0.02))
    simulation.relax()
    other.relax()
    assert np.array_equal(simulation.heights, other.heights)
    assert steepest(simulation.heights) > 10.0
    with pytest.raises(sandstroke.InputError, match="sand.layer or moisture"):
        sandstroke.Simulation(moist, laws={"force": lambda depth, motion, tip, **numbers: (0.0, 0.0, 0.0)})


class Table(dict):
    """As much of a DataFrame as counts: columns by name."""

    columns = property(lambda self: list(self))

    def __getitem__(self, names):
        return np.column_stack([dict.__getitem__(self, name) for name in names]) if isinstance(names, list) else (
            dict.__getitem__(self, names))


def test_a_table_is_taken_by_its_names(small, line):
    class Frame:
        def __init__(self, table):
            self.table, self.columns = table, table.columns

        def __getitem__(self, names):
            return self.table[names]

    table = Table(x=line[:, 1], z=line[:, 3], time=line[:, 0], y=line[:, 2])
    assert np.array_equal(sandstroke.run(small, Frame(table)).final, sandstroke.run(small, line).final)
    del table["y"]
    with pytest.raises(sandstroke.InputError, match="y is missing"):
        sandstroke.run(small, Frame(table))


def test_a_surface_of_ones_own(small, line):
    first = sandstroke.run(small, line)
    second = sandstroke.run(small, line + [0, 0, 0.02, 0], surface=first.final)
    assert np.array_equal(second.initial, first.final)
    sim = sandstroke.Simulation(small, surface=first.final)
    assert np.array_equal(sim.heights, first.final)
    for surface, sentence in [(first.final[1:], "59 rows"), (first.final[0], "two dimensions"),
                              (np.full_like(first.final, np.nan), "not a number"), ("sand", "two dimensions")]:
        with pytest.raises(sandstroke.InputError, match=sentence):
            sandstroke.run(small, line, surface=surface)


def test_what_is_under_a_mask_is_neither_sand_nor_stroke(small, line):
    surface = np.ma.array(np.zeros_like(sandstroke.run(small, line).final))
    assert np.array_equal(sandstroke.run(small, line, surface=surface).initial, surface.data)  # nothing is masked
    surface[:5, :4] = -9999.0
    surface[:5, :4] = np.ma.masked
    for start in (sandstroke.run, lambda scene, _, surface: sandstroke.Simulation(scene, surface=surface)):
        with pytest.raises(sandstroke.InputError, match=f"20 of the bed's {surface.size} cells have no height.*filled"):
            start(small, line, surface=surface)
        with pytest.raises(sandstroke.InputError, match="heights from -9999 to 0 m"):
            start(small, line, surface=surface.data)
    assert sandstroke.run(small, line, surface=surface.filled(0.0)).initial.min() == 0.0
    masked = np.ma.array(line)
    masked[3, 1:] = np.ma.masked
    for stroke in (masked, {"time": masked[:, 0], "position": masked[:, 1:]}):
        with pytest.raises(sandstroke.InputError, match="position has 3 masked numbers"):
            sandstroke.run(small, stroke)
    states = np.ma.array(np.ones(len(line)), mask=masked.mask[:, 1])
    with pytest.raises(sandstroke.InputError, match="pen_down has masked values"):
        sandstroke.run(small, {"time": line[:, 0], "position": line[:, 1:], "pen_down": states})
    with pytest.raises(sandstroke.InputError, match="not a number"), warnings.catch_warnings():
        warnings.simplefilter("ignore")  # NumPy's, of the masked number
        sandstroke.Simulation(small).tick(masked[3, 1:])


def test_samples_far_apart_are_joined_where_that_is_asked(small):
    ends = {"time": [0.0, 0.4], "position": [[-0.05, 0.0, -0.003], [0.05, 0.0, -0.003]]}
    assert sandstroke.run(small, {**ends, "gap_threshold": 1.0}).summary["contact_ticks"] > 300
    with pytest.raises(sandstroke.InputError, match="gap_threshold"):
        sandstroke.run(small, {**ends, "gap_threshold": 0.0})


def test_the_axes_say_where_cells_are(small, line):
    run = sandstroke.run(small, line)
    assert run.final.shape == (60, 100) == (len(run.y), len(run.x))
    assert run.cell_size == pytest.approx(0.002)
    assert np.allclose(np.diff(run.x), 0.002) and abs(run.x.sum()) < 1e-12
    row, column = np.unravel_index(run.final.argmin(), run.final.shape)
    assert abs(run.y[row]) < 0.01 and -0.06 < run.x[column] < 0.06  # in the furrow along x


def test_arrays_are_no_copies_read_only_and_outlive_the_run(small, line):
    run = sandstroke.run(small, line)
    assert np.shares_memory(run.final, run.final) and np.shares_memory(run.trace["depth"], run.trace["depth"])
    with pytest.raises(ValueError):
        run.final[0, 0] = 1.0
    final, depth = run.final, run.trace["depth"]
    volume, deepest = final.sum(), depth.max()
    del run
    gc.collect()
    assert final.sum() == volume and depth.max() == deepest


def test_frames(small, line):
    run = sandstroke.run(small, line, settings={"output.frames": 10})
    assert len(run.frame_times) == len(run.frames) == 5  # at 0, 0.1, ... 0.4 s
    assert np.array_equal(run.frames[0], run.initial)
    assert run.frames[-1].min() < -0.002


def test_the_floor_under_the_sand(small, line, tmp_path):
    h5py, xarray = needs("h5py"), needs("xarray")
    path = tmp_path / "run.h5"
    run = sandstroke.run(small, line, output=path)
    assert run.floor is None and sandstroke.read(path).floor is None
    floor = np.full(run.final.shape, np.nan)
    floor[10:50, 20:60] = min(run.initial.min(), run.final.min())
    with h5py.File(path, "r+") as file:
        file["/surface/floor"] = floor
    on_stone = sandstroke.read(path)
    assert np.array_equal(on_stone.floor, floor, equal_nan=True) and not on_stone.floor.flags.writeable
    assert np.array_equal(on_stone.final, run.final)
    with xarray.open_dataset(path, group="surface", engine="h5netcdf", phony_dims="sort") as file:
        assert np.array_equal(on_stone.to_xarray().floor, file.floor, equal_nan=True)
    # A bare stone is gray, whoever names it.
    view = {"name": "top", "size": (320, 180)}
    bare = np.full(run.final.shape, np.nan)
    bare[10:50, 20:60] = run.final[10:50, 20:60]
    sand, stone = (sandstroke.render(run, floor=one, **view).astype(int) for one in (None, bare))
    warmth = [(picture[..., 0] - picture[..., 2])[80:100, 130:190].mean() for picture in (sand, stone)]
    assert warmth[0] > 45 and abs(warmth[1]) < 30
    with pytest.raises(sandstroke.InputError, match="floor: must have as many rows"):
        sandstroke.render(run, floor=bare[1:], **view)


def test_xarray_is_what_it_makes_of_the_file(tmp_path):
    xarray = needs("xarray")
    needs("h5netcdf")
    run = sandstroke.run(SOURCE / "strokes/plough/scene.toml", settings={"output.frames": 2}, output=tmp_path / "run.h5")
    for group in ("surface", "trace", "relaxation"):
        with xarray.open_dataset(tmp_path / "run.h5", group=group, engine="h5netcdf") as file:
            mine = run.to_xarray(group)
            xarray.testing.assert_equal(mine, file)
            for name, variable in file.variables.items():
                if variable.dtype.kind not in "OU":  # text: Python's or, since xarray 2025, NumPy's
                    assert variable.dtype == mine[name].dtype, name
                if name != "final":  # the file's says the furrow, too
                    assert dict(variable.attrs) == dict(mine[name].attrs), name
        xarray.testing.assert_equal(sandstroke.read(tmp_path / "run.h5").to_xarray(group), mine)
    with pytest.raises(sandstroke.InputError, match="the groups are surface, trace and relaxation"):
        run.to_xarray("sand")


@pytest.mark.parametrize("change, sentence", [
    ({"relaxation.talus_angle": 95}, "relaxation.talus_angle"),
    ({"relaxation.talus_angel": 30}, "talus_angle"),  # did you mean
    ({"bed.cells": [100, 61]}, "bed.cells"),
    ({"tool.radius": float("nan")}, "tool.radius"),
    ({"tool.radius": "wide"}, "tool.radius"),
    ({"tool.radius": {1, 2}}, "not a value for a scene"),
    ({"tool.radus": None}, "no such key"),
    ({"force.law": "rft", "force.k_s": 3.0}, "applies only where force.law is paper"),
])
def test_wrong_settings_are_told(small, line, change, sentence):
    with pytest.raises(sandstroke.InputError, match=sentence) as told:
        sandstroke.run(small, line, settings=change)
    assert isinstance(told.value, ValueError) and "--" not in str(told.value)


def test_settings_replace_what_a_scene_sets_for_another_choice(tmp_path):
    scene = {"bed": {"size": [0.3, 0.18], "cells": [100, 60]}, "force": {"k_s": 500.0}}
    with pytest.warns(UserWarning, match="force.k_s is left out, because it applies only where force.law is paper"):
        assert sandstroke.Scene(scene, {"force.law": "rft"})["force.law"] == "rft"
    (tmp_path / "scene.toml").write_text("[force]\nk_s = 500\n")
    with pytest.warns(UserWarning, match="force.k_s is left out"):
        sandstroke.Scene(tmp_path / "scene.toml", {"force.law": "archimedes"})
    assert sandstroke.Scene(scene, {"force.k_s": None})["force.k_s"] == 1000.0
    with pytest.warns(UserWarning, match="force.k_s"):
        sandstroke.Scene(sandstroke.Scene(scene), {"force.law": "rft"})


@pytest.mark.parametrize("stroke, sentence", [
    (np.zeros((5, 3)), r"columns time, x, y and z.*\(5, 3\)"),
    (np.zeros(4), "columns time"),
    (np.array([["a"] * 4]), "columns time"),
    ({"time": [0.0, 1.0]}, "needs the column position"),
    ({"time": [0.0, 1.0], "position": np.zeros((2, 2))}, r"position has the shape \(2, 2\); it must be \(n, 3\)"),
    ({"time": [0.0, 1.0], "position": np.zeros((3, 3))}, "position"),
    ({"time": [1.0, 0.0], "position": np.zeros((2, 3))}, "time"),
    ({"time": [0.0, np.nan], "position": np.zeros((2, 3))}, "time"),
    ({"time": [0.0, 1.0], "position": np.full((2, 3), np.inf)}, "position"),
    ({"time": [0.0, 1.0], "position": np.zeros((2, 3)), "speed": [1, 2]}, "'speed' is not a column"),
    ({"time": [0.0, 1.0], "position": "here"}, "array of numbers"),
    ({"time": [0.0], "x": [0.0], "y": [0.0], "z": [0.0]}, "x, y and z are the columns of position"),
    ({"time": [], "position": np.zeros((0, 3))}, "stroke"),
])
def test_wrong_strokes_are_told(small, stroke, sentence):
    with pytest.raises(sandstroke.InputError, match=sentence):
        sandstroke.run(small, stroke)


@pytest.mark.parametrize("scene", [np.zeros((3, 4)), None, 3])
def test_what_is_no_scene_is_told(line, scene):
    with pytest.raises(sandstroke.InputError, match="scene: give a TOML file"):
        sandstroke.run(scene, line)


def test_files_that_are_not_there_are_told(tmp_path, small, line):
    with pytest.raises(sandstroke.FileError, match="nothing.toml"):
        sandstroke.run(tmp_path / "nothing.toml")
    with pytest.raises(OSError, match="nothing.h5"):
        sandstroke.read(tmp_path / "nothing.h5")
    with pytest.raises(sandstroke.InputError, match="needs a file"):
        sandstroke.compare(sandstroke.run(small, line), tmp_path / "nothing.h5")
    for name in ("hight", "pixel"):
        with pytest.raises(sandstroke.InputError, match=f"'{name}' is not a tolerance of runs"):
            sandstroke.compare(tmp_path / "a.h5", tmp_path / "b.h5", **{name: 1.0})
    for value in (-1.0, float("inf"), float("nan")):
        with pytest.raises(sandstroke.InputError, match="force is .*; give a number 0 or more"):
            sandstroke.compare(tmp_path / "a.h5", tmp_path / "b.h5", force=value)


def test_what_the_command_warns_of_is_a_python_warning(small, line):
    high = line + [0.0, 0.0, 0.0, 0.05]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(UserWarning):
            sandstroke.run(small, line[::10], settings={"stroke.smooth": 80.0})  # of 100 Hz
        sandstroke.run(small, line)
    with pytest.warns(UserWarning, match="never touched the sand"):
        assert sandstroke.run(small, high).summary["contact_ticks"] == 0
    with pytest.warns(UserWarning, match="not at rest"):
        assert not sandstroke.run(small, line, settings={"relaxation.max_passes": 3}).summary["converged"]


def test_warnings_of_a_result_have_a_code(small, line):
    with pytest.warns(sandstroke.ResultWarning) as told:
        summary = sandstroke.run(small, line, settings={"relaxation.max_passes": 3}).summary
    assert {"not-at-rest"} <= {warning.message.code for warning in told}
    assert [w["code"] for w in summary["warnings"]] == [w.message.code for w in told]
    assert summary["warnings"][-1]["section"] == "relaxation"


def test_other_threads_run_meanwhile_and_runs_in_threads_are_the_same(small, line):
    small["bed"]["cells"] = [400, 240]  # so that they take a while
    one = sandstroke.run(small, line, threads=1)
    results = [None] * 4

    def work(i):
        results[i] = sandstroke.run(small, line, threads=1)

    workers = [threading.Thread(target=work, args=(i,)) for i in range(4)]
    for worker in workers:
        worker.start()
    counted = 0
    while any(worker.is_alive() for worker in workers):
        counted += 1
        time.sleep(0)
    for worker in workers:
        worker.join()
    assert counted > 10
    for result in results:
        assert np.array_equal(result.final, one.final)


def _final_sum(arguments):
    scene, stroke = arguments
    return sandstroke.run(scene, stroke).final.tobytes()


@pytest.mark.parametrize("method", ["fork", "spawn"])
def test_runs_in_processes_are_the_same(small, line, method):
    import multiprocessing
    expected = sandstroke.run(small, line).final.tobytes()
    with multiprocessing.get_context(method).Pool(2) as pool:
        assert pool.map(_final_sum, [(small, line)] * 4) == [expected] * 4


def test_ctrl_c_ends_a_run(tmp_path):
    program = (
        "import sandstroke, sys\n"
        "print('begun', flush=True)\n"
        "sandstroke.run({'bed': {'size': [4.0, 4.0], 'cells': [2000, 2000], 'surface': {'kind': 'noise', 'amplitude': 1.0}},"
        " 'relaxation': {'tolerance': 1e-9}})\n")
    child = subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert child.stdout.readline() == "begun\n"
    time.sleep(1.0)
    child.send_signal(signal.SIGINT)
    _, said = child.communicate(timeout=600)
    assert "KeyboardInterrupt" in said and child.returncode != 0


def test_many_runs_leak_nothing(small, line):
    few = line[:20]
    tiny = {**small, "bed": {"size": [0.2, 0.12], "cells": [50, 30]}}

    def play(times):
        for _ in range(times):
            sandstroke.run(tiny, few, threads=1)
        gc.collect()
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss  # kB

    runs = int(os.environ.get("SANDSTROKE_SHORT_RUNS", "1000"))
    before = play(200)
    assert play(runs) - before < 2000 + 0.2 * runs


def test_a_picture_is_that_of_the_command(tmp_path):
    scene = SOURCE / "strokes/weakening/scene.toml"
    run = sandstroke.run(scene, output=tmp_path / "run.h5")
    picture = sandstroke.render(run, name="top", size=(320, 180))
    assert picture.shape == (180, 320, 3) and picture.dtype == np.uint8
    assert run_program("render", tmp_path / "run.h5", "-o", tmp_path / "a.png", "--view", "top", "--size", "320x180",
                       "--no-tool").returncode == 0
    plt = needs("matplotlib.image")
    drawn = (255 * plt.imread(tmp_path / "a.png")[:, :, :3]).round().astype(np.uint8)
    assert np.array_equal(picture, drawn)
    with_tool = sandstroke.render(run, name="top", size=(320, 180), tool=(0.0, 0.0, 0.0))
    assert not np.array_equal(picture, with_tool)
    with pytest.raises(sandstroke.InputError, match="scene=..."):
        sandstroke.render(run.final)
    assert np.array_equal(sandstroke.render(run.final, run.scene, start=run.initial, name="top", size=(320, 180)), picture)
    with pytest.raises(sandstroke.InputError, match="two dimensions"):
        sandstroke.render(run.final[0], run.scene)
    with pytest.raises(sandstroke.InputError, match="not a number"):
        sandstroke.render(np.full((4, 4), np.nan), run.scene)


def test_what_the_page_of_the_module_shows_works(tmp_path):
    needs("matplotlib")
    page = (SOURCE / "src/python/README.md").read_text()
    blocks = re.findall(r"^ *```python\n(.*?)^ *```", page, re.DOTALL | re.MULTILINE)
    assert len(blocks) >= 5
    program = "import matplotlib\nmatplotlib.use('Agg')\nimport multiprocessing\n" + "\n".join(map(textwrap.dedent, blocks))
    done = subprocess.run([sys.executable, "-c", program], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "furrow.png").stat().st_size > 1000


@pytest.mark.parametrize("down", [True, 1, 0.5, 256, -1, np.True_])
@pytest.mark.parametrize("up", [False, 0, 0.0])
def test_pen_down_is_any_truth(small, line, down, up):
    states = [up] * 100 + [down] * (len(line) - 100)
    stroke = {"time": line[:, 0], "position": line[:, 1:], "pen_down": states}
    plain = {**stroke, "pen_down": np.array([bool(state) for state in states])}
    assert np.array_equal(sandstroke.run(small, stroke).final, sandstroke.run(small, plain).final)


@pytest.mark.parametrize("state", [np.nan, "up"])
def test_pen_down_that_is_no_truth_is_told(small, line, state):
    stroke = {"time": line[:, 0], "position": line[:, 1:], "pen_down": [state] * len(line)}
    with pytest.raises(sandstroke.InputError, match="pen_down must be true or false"):
        sandstroke.run(small, stroke)


def test_a_run_from_a_file_has_the_summary_that_it_tells(tmp_path, small, line):
    made = sandstroke.run(small, line, output=tmp_path / "run.h5").summary
    read = sandstroke.read(tmp_path / "run.h5").summary
    assert {"max_force", "max_depth", "contact_ticks", "moved_volume", "passes"} <= read.keys() <= made.keys()
    for name, value in read.items():
        assert value == pytest.approx(made[name], rel=1e-9, abs=1e-15) if isinstance(value, float) else value == made[name], name
