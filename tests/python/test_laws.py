"""Laws that are Python functions take the place of the model's, and are watched."""
import numpy as np
import pytest

import sandstroke


def relax(heights, walls, *, cell_size, talus_slope, **_):
    """The axis neighbours' excess over the talus slope goes down by a quarter, until there is none."""
    open_ = ~walls
    for passes in range(1, 5000):
        change = np.zeros_like(heights)
        for axis in (0, 1):
            low, high = [slice(None)] * 2, [slice(None)] * 2
            low[axis], high[axis] = slice(None, -1), slice(1, None)
            low, high = tuple(low), tuple(high)
            step = heights[low] - heights[high]
            flow = np.sign(step) * np.maximum(np.abs(step) - talus_slope * cell_size, 0) / 8
            flow = np.where(open_[low] & open_[high], flow, 0.0)
            change[low] -= flow
            change[high] += flow
        if np.abs(change).max() < 1e-7:
            return passes
        heights += change


def ahead(heights, underside, motion, **_):
    """All of it to the cells right ahead of the tool."""
    taken = np.where(np.isfinite(underside), np.maximum(heights - underside, 0), 0)
    heights -= taken
    free = ~np.isfinite(underside)
    free[:, : heights.shape[1] // 2] = False  # +x is ahead
    heights[free] += taken.sum() / free.sum()


def spring(depth, motion, tip, *, parameters, **_):
    return (0.0, 0.0, parameters[0] * depth)


def test_a_relaxation_of_ones_own_comes_to_rest_at_the_talus_slope(small):
    small["bed"] = {"size": [0.2, 0.2], "cells": [50, 50], "surface": {"kind": "cylinder", "radius": 0.05, "height": 0.06}}
    with pytest.warns(UserWarning, match="not at rest"):  # as the model's law sees it, in other directions
        own = sandstroke.run(small, laws={"relaxation": relax})
    models = sandstroke.run(small)
    for run in (own, models):
        slope = np.abs(np.diff(run.final, axis=1)).max() / run.cell_size
        assert slope == pytest.approx(np.tan(np.radians(30)), rel=0.01)
    assert own.summary["passes"] > 10 and own.summary["volume_drift"] < 1e-12
    assert np.abs(own.final - own.final.T).max() < 1e-12
    assert "relaxation = \"relax\"" in own.scene.text


def test_a_displacement_of_ones_own_leaves_its_sand_ahead(small, line):
    settings = {"relaxation.rate": 0.0, "relaxation.way": 0.0, "relaxation.talus_angle": 80}
    run = sandstroke.run(small, line, settings=settings, laws={"displacement": ahead})
    assert run.summary["volume_drift"] < 1e-12 and run.final.min() == pytest.approx(-0.003, abs=1e-4)
    outward = sandstroke.run(small, line, settings=settings)
    behind = run.x < -0.05 - 0.004  # where the tool began
    assert run.final[:, behind].max() == 0.0 < outward.final[:, behind].max()


def test_a_force_of_ones_own_is_felt(small, line):
    run = sandstroke.run(small, line, settings={"model.parameters": [250.0, 0, 0, 0]}, laws={"force": spring})
    contact = run.trace["contact"]
    assert contact.sum() > 300
    assert np.allclose(run.trace["device_force"][contact, 2], 250.0 * run.trace["depth"][contact])
    sim = sandstroke.Simulation(small, settings={"model.parameters": [250.0, 0, 0, 0]}, laws={"force": spring})
    assert sim.tick((0.0, 0.0, -0.002)).force[2] == pytest.approx(0.5, rel=0.1)


def losing(heights, walls, **_):
    heights[0, 0] -= 1e-3


def not_a_number(heights, walls, **_):
    heights[3, 3] = np.nan


def failing(*_, **__):
    raise ValueError("no idea")


@pytest.mark.parametrize("laws, error, sentence", [
    ({"relaxation": losing}, sandstroke.UnstableError, "losing"),
    ({"relaxation": not_a_number}, sandstroke.UnstableError, "not_a_number"),
    ({"relaxation": failing}, sandstroke.InputError, "failing.*no idea"),
    ({"displacement": failing}, sandstroke.InputError, "failing.*no idea"),
    ({"force": failing}, sandstroke.InputError, "failing.*no idea"),
    ({"force": lambda *_, **__: (0.0, np.nan, 0.0)}, sandstroke.UnstableError, "not a number"),
    ({"force": lambda *_, **__: 3.0}, sandstroke.InputError, "three numbers"),
    ({"force": 3.0}, sandstroke.InputError, "is not a function"),
    ({"relaxation": lambda heights, *_, **__: heights}, sandstroke.InputError, "change heights in place"),
    (spring, sandstroke.InputError, "laws: give"),
    ({"friction": failing}, sandstroke.InputError, "unknown kind 'friction'; use relaxation, displacement or force"),
])
def test_wrong_laws_are_told(small, line, laws, error, sentence):
    with pytest.raises(error, match=sentence):
        sandstroke.run(small, line, laws=laws)


def test_a_relaxation_that_leaves_steep_sand_is_not_at_rest(small):
    small["bed"] = {"size": [0.2, 0.2], "cells": [50, 50], "surface": {"kind": "cylinder", "radius": 0.05, "height": 0.06}}
    with pytest.warns(UserWarning, match="not at rest"):
        run = sandstroke.run(small, laws={"relaxation": lambda *_, **__: None})
    assert not run.summary["converged"] and run.summary["residual"] > 1.0


def test_ctrl_c_in_a_law_is_ctrl_c(small, line):
    def interrupted(*_, **__):
        raise KeyboardInterrupt

    for kind in ("relaxation", "displacement", "force"):
        with pytest.raises(KeyboardInterrupt):
            sandstroke.run(small, line, laws={kind: interrupted})
    sandstroke.run(small, line)


def test_bench_says_whether_laws_converge(tmp_path):
    found = sandstroke.bench({"force": spring, "displacement": ahead}, tmp_path / "bench", parameters=[500.0])
    assert (tmp_path / "bench/bench.html").stat().st_size > 10_000
    series = {run["series"] for run in found["runs"]}
    assert any("spring" in one for one in series) and any("ahead" in one for one in series)
    assert max(run["volume_drift"] or 0.0 for run in found["runs"]) < 1e-9


def test_stress_finds_no_surprise_in_a_sound_law_and_one_in_another(tmp_path):
    sound = sandstroke.stress({"force": spring}, parameters=[500.0])
    assert len(sound["cases"]) > 5 and not any(case["surprise"] for case in sound["cases"])
    wrong = sandstroke.stress({"force": lambda *_, **__: (0.0, np.nan, 0.0)})
    assert any(case["surprise"] for case in wrong["cases"])
    with pytest.raises(sandstroke.InputError, match="four at most"):
        sandstroke.stress({"force": spring}, parameters=range(5))


@pytest.mark.parametrize("spoil", [
    lambda heights: setattr(heights, "shape", (1, heights.size)),
    lambda heights: setattr(heights, "shape", (heights.size,)),
    lambda heights: setattr(heights, "dtype", np.int64),
    lambda heights: heights.setflags(write=False),
], ids=["a row", "flat", "integers", "read only"])
def test_a_law_may_reshape_and_keep_its_arrays(small, line, spoil):
    kept = []

    def law(heights, walls, **numbers):
        kept.append(heights)
        spoil(heights)
        walls.shape = (walls.size,)

    def displace(heights, underside, motion, **numbers):
        kept.append(heights)
        spoil(heights)

    run = sandstroke.run(small, line[:20], laws={"relaxation": law, "displacement": displace})
    assert np.array_equal(run.final, run.initial)
    assert len(kept) > 10 and all(np.isfinite(np.asarray(one, dtype=float)).all() for one in kept)
