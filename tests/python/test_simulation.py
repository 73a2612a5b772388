"""Ticks that Python drives are those of a run."""
import copy
import gc
import pickle
import resource
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import sandstroke

RFT = {"force.law": "rft"}


def test_ticks_have_the_bits_of_a_run(small, line):
    run = sandstroke.run(small, line, settings=RFT)
    sim = sandstroke.Simulation(small, settings=RFT)
    for k, position in enumerate(run.trace["hand_position"]):
        tick = sim.tick(position)
        assert tick.time == run.trace["time"][k]
        assert np.array_equal(tick.force, run.trace["device_force"][k])
        assert np.array_equal(tick.torque, run.trace["torque"][k])
        assert tick.depth == run.trace["depth"][k] and tick.contact == run.trace["contact"][k]
    sim.lift()
    assert sim.relax()["converged"]
    assert np.array_equal(sim.heights, run.final)
    assert np.array_equal(sim.x, run.x) and np.array_equal(sim.y, run.y)


def test_sand_keeps_its_volume_and_relaxes_when_told(small):
    sim = sandstroke.Simulation(small, relaxes=False)
    for k in range(200):
        sim.tick([-0.05 + 5e-4 * k, 0.0, -0.006])
    steep = np.abs(np.diff(sim.heights, axis=0)).max()
    sim.lift()
    assert sim.relax()["passes"] > 0
    assert np.abs(np.diff(sim.heights, axis=0)).max() < steep
    assert abs(sim.volume) < 1e-15
    assert sim.height_at(0.0, 0.0) < -0.002 and np.isnan(sim.height_at(1.0, 0.0))


@pytest.mark.parametrize("device", ["kinematic", "dynamic"])
def test_a_copy_goes_on_by_itself(small, device):
    def hand(k):
        return (-0.05 + 5e-4 * k, 0.002 * np.sin(0.3 * k), -0.005)

    sim = sandstroke.Simulation(small, settings={**RFT, "device.model": device})
    for k in range(60):
        sim.tick(hand(k))
    tried, other, third = sim.copy(), copy.copy(sim), copy.deepcopy(sim)
    here = sim.heights
    forces = [tried.tick(hand(k)).force for k in range(60, 120)]
    assert np.array_equal(sim.heights, here) and not np.array_equal(tried.heights, here)
    assert sim.time == other.time == third.time == 0.06 and tried.time == 0.12

    def go_on(one, result):
        result.extend(one.tick(hand(k)).force for k in range(60, 120))

    others = [(one, []) for one in (sim, other, third)]
    threads = [threading.Thread(target=go_on, args=pair) for pair in others]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for one, result in others:
        assert np.array_equal(result, forces)
        assert np.array_equal(one.heights, tried.heights)


def test_copies_treat_what_a_subclass_adds_as_python_does(small):
    class Sculptor(sandstroke.Simulation):
        def __init__(self, scene):
            super().__init__(scene)
            self.reached = [0.0]

    sim = Sculptor(small)
    shallow, deep = copy.copy(sim), copy.deepcopy(sim)
    assert type(shallow) is type(deep) is Sculptor
    sim.reached.append(1.0)
    assert shallow.reached == [0.0, 1.0] and deep.reached == [0.0]
    deep.tick((0.0, 0.0, -0.004))
    assert sim.time == shallow.time == 0.0 and deep.time == 0.001


class Measured(sandstroke.Simulation):
    reached = ()


def test_pickle_keeps_class_and_attributes(small):
    sim = Measured(small, relaxes=False)
    sim.reached = [1.0, 2.0]
    again = pickle.loads(pickle.dumps(sim))
    assert type(again) is Measured and again.reached == [1.0, 2.0]
    for k in range(40):
        for one in (sim, again):
            one.tick((-0.05 + 5e-4 * k, 0.0, -0.006))
    assert np.array_equal(sim.heights, again.heights)


GO_ON = """
import pickle, sys
import numpy as np
import sandstroke
sim = sandstroke.Simulation.load(sys.argv[1])
forces = [sim.tick((-0.05 + 5e-4 * k, 0.002 * np.sin(0.3 * k), -0.005)).force for k in range(60, 120)]
np.savez(sys.argv[2], forces=forces, heights=sim.heights)
"""


@pytest.mark.parametrize("settings", [RFT, {"device.model": "dynamic", "device.delay": 2},
                                      {"model.preset": "accurate", "tool.shape": "plate", "tool.width": 0.03}])
def test_a_state_goes_on_in_another_process_with_the_same_bits(small, tmp_path, settings):
    def hand(k):
        return (-0.05 + 5e-4 * k, 0.002 * np.sin(0.3 * k), -0.005)

    surface = 0.001 * np.random.default_rng(1).random(sandstroke.Simulation(small).heights.shape)
    sim = sandstroke.Simulation(small, settings=settings, surface=surface)
    for k in range(60):
        sim.tick(hand(k))
    sim.save(tmp_path / "sim.state")
    pickled = pickle.loads(pickle.dumps(sim))
    other = sandstroke.Simulation(small, settings=settings)
    other.set_state(sim.state())
    forces = [sim.tick(hand(k)).force for k in range(60, 120)]
    subprocess.run([sys.executable, "-c", GO_ON, tmp_path / "sim.state", tmp_path / "on.npz"], check=True)
    on = np.load(tmp_path / "on.npz")
    assert np.array_equal(on["forces"], forces) and np.array_equal(on["heights"], sim.heights)
    for one in (pickled, other):
        assert np.array_equal([one.tick(hand(k)).force for k in range(60, 120)], forces)
        assert np.array_equal(one.heights, sim.heights)
    pickled.reset()
    assert pickled.time == 0.06
    tick = sim.tick
    sim.reset()
    assert sim.time == 0.0 and np.array_equal(sim.heights, surface)
    tick(hand(0))  # the name goes on with the same simulation
    assert sim.time == 0.001


def test_a_scene_named_in_its_folder_is_kept_and_loaded_from_another(tmp_path, monkeypatch):
    (tmp_path / "scene.toml").write_text("[bed]\nsize = [0.1, 0.1]\ncells = [40, 40]\n")
    monkeypatch.chdir(tmp_path)
    sim = sandstroke.Simulation("scene.toml")
    sim.tick((0.0, 0.0, -0.004))
    sim.save("sim.state")
    monkeypatch.chdir("/")
    assert np.array_equal(sandstroke.Simulation.load(tmp_path / "sim.state").heights, sim.heights)
    assert pickle.loads(pickle.dumps(sim)).time == 0.001


def test_a_state_of_another_scene_or_file_is_refused(small, tmp_path):
    sim, steeper = sandstroke.Simulation(small), sandstroke.Simulation(small, settings={"relaxation.talus_angle": 34})
    steeper.tick((0.0, 0.0, -0.004))
    with pytest.raises(sandstroke.InputError, match="talus_angle = 34.*talus_angle = 30"):
        sim.set_state(steeper.state())
    assert sim.time == 0.0
    with pytest.raises(sandstroke.InputError, match="cut off"):
        sim.set_state(sim.state()[:-100])
    notes = tmp_path / "notes.txt"
    notes.write_text("mine")
    with pytest.raises(sandstroke.InputError, match="notes.txt.*not a simulation's state"):
        sandstroke.Simulation.load(notes)
    with pytest.raises(sandstroke.Error, match="notes.txt"):
        sim.save(notes)
    assert notes.read_text() == "mine"
    with pytest.raises(sandstroke.FileError, match="none.state: cannot be read"):
        sandstroke.Simulation.load(tmp_path / "none.state")


@pytest.mark.parametrize("threads", [0, 1, 3])
def test_many_are_stepped_at_once_with_the_bits_of_each(small, threads):
    start = sandstroke.Simulation(small, settings={**RFT, "device.model": "dynamic"})
    for k in range(30):
        start.tick((-0.05 + 5e-4 * k, 0.0, -0.005))
    sims, alone = [start.copy() for _ in range(6)], [start.copy() for _ in range(6)]
    hands = np.random.default_rng(2).uniform(-1e-3, 1e-3, (6, 40, 3)) + (-0.03, 0.0, -0.005)
    down = np.ones((6, 40), bool)
    down[2, 10:20] = False
    ticks = sandstroke.step_many(sims, hands, down=down, velocities=(0.01, 0.0, 0.0),
                                 orientations=(0.0, 0.0, np.sin(0.1), np.cos(0.1)), threads=threads)
    assert ticks.force.shape == (6, 40, 3) and ticks.depth.shape == ticks.contact.shape == (6, 40)
    for i, one in enumerate(alone):
        for k in range(40):
            tick = one.tick(hands[i, k], (0.01, 0.0, 0.0), down=down[i, k],
                            orientation=(0.0, 0.0, np.sin(0.1), np.cos(0.1)))
            for name in ("time", "force", "sand_force", "torque", "depth", "level", "contact", "carried",
                         "displaced_volume", "position"):
                assert np.array_equal(getattr(ticks, name)[i, k], getattr(tick, name), equal_nan=True), name
        assert np.array_equal(one.heights, sims[i].heights)
    assert start.time == 0.03


def test_what_many_cannot_do_is_said_with_its_number(small):
    sims = [sandstroke.Simulation(small) for _ in range(3)]
    hands = np.zeros((3, 5, 3)) - (0.0, 0.0, 0.004)
    with pytest.raises(sandstroke.InputError, match="hands: give an array of 2 simulations x ticks x 3"):
        sandstroke.step_many(sims[:2], hands)
    with pytest.raises(sandstroke.InputError, match="down: does not fit 3 simulations x 5 ticks"):
        sandstroke.step_many(sims, hands, down=[True, False])
    with pytest.raises(sandstroke.InputError, match="number 2 is there twice"):
        sandstroke.step_many([sims[0], sims[1], sims[0]], hands)
    with pytest.raises(sandstroke.InputError, match="down: some of it is masked"):
        sandstroke.step_many(sims, hands, down=np.ma.array([[True] * 5], mask=[[False] * 4 + [True]]))
    masked = np.ma.array(hands, mask=False)
    masked[1, 2] = np.ma.masked
    with pytest.raises(sandstroke.InputError, match="simulation 1: at 0.0020 s .* not a number"):
        sandstroke.step_many(sims, masked)
    assert [sim.time for sim in sims] == [0.005, 0.002, 0.005]
    mine = sandstroke.Simulation(small, laws={"force": lambda depth, motion, tip, **numbers: (0.0, 0.0, 1.0)})
    with pytest.raises(sandstroke.InputError, match="number 1 has a law that is a Python function"):
        sandstroke.step_many([sims[0], mine], hands[:2])
    assert sandstroke.step_many([], np.zeros((0, 4, 3))).force.shape == (0, 4, 3)


def test_a_copy_with_a_law_of_ones_own_is_refused(small):
    def spring(depth, motion, tip, **numbers):
        return (0.0, 0.0, 100.0 * max(depth, 0.0))

    sim = sandstroke.Simulation(small, laws={"force": spring})
    sim.tick((0.0, 0.0, -0.004))
    with pytest.raises(sandstroke.InputError, match="force .*cannot be copied"):
        sim.copy()
    with pytest.raises(sandstroke.InputError, match="law of force"):
        sim.state()
    with pytest.raises(sandstroke.InputError, match="reset"):
        sim.reset()
    assert sim.tick((0.0, 0.0, -0.004)).force[2] > 0.0


def test_relaxation_has_a_former_name(small):
    one, other = (sandstroke.Simulation(small, **{name: False}) for name in ("relaxes", "slips"))
    for sim in (one, other):
        for k in range(20):
            sim.tick([-0.05 + 5e-4 * k, 0.0, -0.006])
    assert np.array_equal(one.heights, other.heights)


def test_a_hand_that_is_lifted_or_turned(small):
    small["tool"] = {"shape": "plate", "width": 0.06, "height": 0.02}
    sim = sandstroke.Simulation(small)
    assert sim.tick((0.0, 0.0, -0.004), down=False).contact is False
    assert sim.heights.min() == 0.0
    sim.tick((0.0, 0.0, -0.004), orientation=(0.0, 0.0, np.sin(np.pi / 4), np.cos(np.pi / 4)))
    assert sim.height_at(0.025, 0.0) < -0.003 and sim.height_at(0.0, 0.025) > -0.001  # its width along x


def test_a_controller_holds_a_force(small):
    """A hand that goes by the force it feels reaches it: the loop is closed in Python."""
    sim = sandstroke.Simulation(small, settings={**RFT, "force.density": 5000.0})
    wanted, z, x = 0.5, 0.0, -0.06
    for _ in range(1500):
        felt = sim.tick((x, 0.0, z)).force[2]
        z -= 2e-5 * np.clip(wanted - felt, -1.0, 1.0)
        x += 5e-5
    assert felt == pytest.approx(wanted, abs=0.1)


def test_arguments_of_any_kind_and_wrong_ones(small):
    sim = sandstroke.Simulation(small)
    for position in [(0, 0, 1), [0.0, 0.0, 1.0], np.zeros(3), np.zeros(3, dtype=np.float32), np.zeros(6)[::2]]:
        sim.tick(position)
    for position in [(0.0, 0.0), "abc", None, np.zeros((3, 1)), [1, 2, "x"], np.zeros(4), 1.0]:
        with pytest.raises(sandstroke.InputError, match="position: give 3 numbers"):
            sim.tick(position)
    with pytest.raises(sandstroke.InputError, match="not a number"):
        sim.tick((0.0, np.nan, 0.0))
    with pytest.raises(sandstroke.InputError, match="velocity"):
        sim.tick((0.0, 0.0, 0.0), (1.0,))
    with pytest.raises(sandstroke.InputError, match="quaternion"):
        sim.tick((0.0, 0.0, 0.0), orientation=(0, 0, 0, 0))
    with pytest.raises(sandstroke.InputError, match="implicit"):
        sandstroke.Simulation(small, settings={"device.model": "dynamic", "device.drag": "implicit"})


def test_many_simulations_leak_nothing(small):
    def make(times):
        for _ in range(times):
            sandstroke.Simulation(small).tick((0.0, 0.0, -0.003))
        gc.collect()
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss  # kB

    before = make(100)
    assert make(500) - before < 2000


@pytest.mark.parametrize("use", [
    lambda sim, k: sim.tick((0.02 * np.sin(0.01 * k), 0.01, -0.003)),
    lambda sim, k: sim.relax(),
    lambda sim, k: sim.lift(),
    lambda sim, k: sim.heights,
    lambda sim, k: (sim.volume, sim.time, sim.height_at(0.0, 0.0), sim.x, sim.y),
], ids=["tick", "relax", "lift", "heights", "numbers"])
def test_two_threads_take_turns(small, use):
    sim = sandstroke.Simulation(small)
    stop, failures = threading.Event(), []

    def other():
        try:
            k = 0
            while not stop.is_set():
                k += 1
                use(sim, k)
        except BaseException as failure:
            failures.append(failure)

    thread = threading.Thread(target=other)
    thread.start()
    for k in range(1000):
        sim.tick((0.04 * np.sin(0.01 * k), 0.0, -0.003))
    stop.set()
    thread.join()
    assert not failures and abs(sim.volume) < 1e-12
    assert np.isfinite(sim.heights).all()


def test_a_law_cannot_use_the_simulation_that_called_it(small):
    def law(depth, motion, tip, **numbers):
        sims[0].tick((0.0, 0.0, 0.0))

    sims = [sandstroke.Simulation(small, laws={"force": law})]
    with pytest.raises(sandstroke.InputError, match="uses the simulation that has called it"):
        sims[0].tick((0.0, 0.0, -0.003))


@pytest.mark.parametrize("velocity", [1e51, 1e154, 1e308, -1e308])
def test_velocities_have_the_range_of_strokes(small, line, velocity):
    with pytest.raises(sandstroke.InputError, match="beyond 1e.50"):
        sandstroke.Simulation(small).tick((0.0, 0.0, -0.003), (velocity, 0.0, 0.0))
    stroke = {"time": line[:, 0], "position": line[:, 1:], "velocity": np.full((len(line), 3), velocity)}
    with pytest.raises(sandstroke.InputError, match="velocity of sample 0"):
        sandstroke.run(small, stroke)
    fast = sandstroke.Simulation(small).tick((0.0, 0.0, -0.003), (1e49, 0.0, 0.0))
    assert np.linalg.norm(fast.force) == pytest.approx(12.0)


IN_A_THREAD = """
import sys, threading, time
import numpy as np, sandstroke
scene = {{"bed": {{"size": [0.3, 0.3], "cells": [300, 300]}}}}
surface = np.random.default_rng(1).normal(0.0, 0.1, (300, 300))
t = np.linspace(0.0, 30.0, 30001)
stroke = np.column_stack([t, 0.002 * t - 0.03, 0.0 * t, 0.0 * t - 0.004])
busy = threading.Event()
def force(depth, motion, tip, **numbers):
    busy.set()
    return 0.0, 0.0, 1.0
def work():
    {work}
threading.Thread(target=work, daemon=True).start()
busy.wait(60)
time.sleep(0.1)
"""


@pytest.mark.parametrize("work", [
    "busy.set(); sandstroke.Simulation(scene, surface=surface).relax()",
    "sandstroke.run(scene, stroke, laws={'force': force})",
    "busy.set(); sandstroke.run(scene, stroke, surface=surface)",
    "sim = sandstroke.Simulation(scene); busy.set()\n    while True: sim.tick((0.0, 0.0, -0.003))",
    "sim = sandstroke.Simulation(scene, surface=surface)\n"
    "    threading.Thread(target=sim.relax, daemon=True).start(); busy.set(); sim.relax()",  # one waits for the other
])
def test_the_interpreter_ends_while_a_daemon_thread_works(work):
    ended = subprocess.run([sys.executable, "-c", IN_A_THREAD.format(work=work)], capture_output=True, text=True,
                           timeout=20)
    assert (ended.returncode, ended.stderr) == (0, ""), ended


def test_floor_and_sources_are_told(small):
    sim = sandstroke.Simulation(small)
    assert sim.floor is None and sim.sources == []
    pouring = sandstroke.Simulation(small, settings={
        "bed.floor": -0.01, "source": [{"at": [0.0, 0.0, 0.05], "rate": 0.01, "stop": 1.0},
                                      {"at": [0.05, 0.0, -0.005], "rate": -1.0, "stop": 1.0}]})
    assert np.array_equal(pouring.floor, np.full(pouring.heights.shape, -0.01))
    for _ in range(200):
        pouring.tick((0.0, 0.0, 0.2), down=False)
    poured, taken = pouring.sources
    assert poured["poured"] == pytest.approx(0.01 * 0.2, rel=1e-12)
    assert poured["landed"] + poured["in_air"] == pytest.approx(poured["poured"], rel=1e-14)
    assert 0.0 < taken["taken"] < taken["asked"] == pytest.approx(0.2, rel=1e-12)
    assert (pouring.heights >= pouring.floor).all()


def test_a_tool_that_carries_sand_keeps_its_books(small):
    assert sandstroke.Simulation(small).on_tool is None
    sim = sandstroke.Simulation(small, settings={
        "model.preset": "accurate", "tool.shape": "cylinder", "tool.radius": 0.02, "tool.height": 0.004,
        "tool.solid": True, "tool.carries": True})
    before, carried = sim.volume, 0.0
    for k in range(400):
        carried = sim.tick((0.0, 0.0, -0.012 + 1e-4 * k)).carried
    sand = sim.on_tool
    assert sand["lifted"] > 1e-6
    assert sand["carried"] * sim.scene["force"]["density"] == pytest.approx(carried, rel=1e-12)
    assert sand["carried"] + sand["spilled"] == pytest.approx(sand["lifted"] + sand["ran_on"], rel=1e-12)
    assert sim.volume + sand["carried"] + sand["in_air"] == pytest.approx(before, abs=1e-15)
