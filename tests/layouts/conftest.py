"""A motion with own numbers, and the comparison of what `stroke convert` makes of a file with it."""
import dataclasses
import os
import pathlib
import re
import subprocess
import sys

import numpy as np
import pytest

sys.path.append(str(pathlib.Path(__file__).parents[1]))
from needs import needs  # noqa: E402

PROGRAM = os.environ["SANDSTROKE_PROGRAM"]
PEN_UP, PEN_DOWN, PEN_LIFTS = 0, 1, 2


class Motion:
    """n samples, 100 a second: a curve with heights, a force, and a tool that turns. All numbers have few digits, so
    that each unit writes them exactly: times in ms, positions in um, forces in mN."""

    def __init__(self, n=240, rate=100):
        k = np.arange(n)
        self.n, self.rate = n, rate
        self.t = np.round(k / rate, 6)
        self.p = np.round(np.column_stack([0.04 * np.sin(0.031 * k + 0.4), 0.03 * np.cos(0.047 * k) + 0.001,
                                           -0.004 + 0.002 * np.sin(0.02 * k)]), 6)
        self.f = np.round(np.column_stack([0.8 * np.cos(0.05 * k), 0.3 * np.sin(0.021 * k), 1.5 + 0.001 * k]), 3)
        half = 0.5 * 0.01 * k
        self.q = np.column_stack([0 * k, 0 * k, np.sin(half), np.cos(half)])
        self.pressure = np.round(0.5 + 0.3 * np.sin(0.03 * k), 3)


@dataclasses.dataclass
class Layout:
    """A file as a program writes it, and what must be read from it."""

    options: list = dataclasses.field(default_factory=list)
    #: asked one after the other: a part of the sentence, and the way out that it tells
    asks: list = dataclasses.field(default_factory=list)
    asked: str = ""  #: the file that the sentences name, if it is another one
    t: np.ndarray = None
    p: np.ndarray = None
    f: np.ndarray = None
    q: np.ndarray = None
    pressure: np.ndarray = None
    lifts: list = dataclasses.field(default_factory=list)  #: samples after which the tool lifts
    path: bool = False  #: corners of a path: only its shape is told, and samples may stand between the corners
    says: str = ""      #: a part of what is printed


def convert(file, out, options):
    return subprocess.run([PROGRAM, "stroke", "convert", str(file), str(out), *options], text=True, capture_output=True)


def read_stroke(file):
    with needs("h5py").File(file) as f:
        stroke = f["stroke"]
        return {name: stroke[name][:] for name in stroke} | {"gap_threshold": float(stroke.attrs["gap_threshold"])}


def lifts_of(stroke):
    """Samples after which the tool is not joined with the next one."""
    lifted = np.diff(stroke["time"]) > stroke["gap_threshold"]
    if "contact" in stroke:
        contact = stroke["contact"]
        lifted |= (contact[:-1] == PEN_LIFTS) | (contact[:-1] == PEN_UP) | (contact[1:] == PEN_UP)
    return list(np.flatnonzero(lifted))


def check(layout, file, tmp_path):
    out = tmp_path / "stroke.h5"
    options = list(layout.options)
    for sentence, way_out in layout.asks:
        run = convert(file, out, options)
        assert run.returncode != 0 and not out.exists(), f"was to ask for {way_out}: {run.stdout}{run.stderr}"
        assert re.search(sentence, run.stderr), run.stderr
        assert (layout.asked or file.name) in run.stderr, run.stderr
        assert way_out[0] in run.stderr, run.stderr
        options += way_out
    run = convert(file, out, options)
    assert run.returncode == 0, run.stderr
    stroke = read_stroke(out)
    said = run.stdout + run.stderr
    assert layout.says in said, said
    if layout.path:
        assert_path(stroke, layout)
        return
    for name, key in (("position", "p"), ("time", "t"), ("force", "f"), ("orientation", "q"), ("pressure", "pressure")):
        want = getattr(layout, key)
        if want is None:
            continue
        assert name in stroke, f"no {name}: {said}"
        assert stroke[name].shape == want.shape, f"{name}: {stroke[name].shape} for {want.shape}; {said}"
        if key == "q":  # q and -q turn alike
            want = want * np.sign(np.sum(want * stroke[name], axis=1, keepdims=True))
        np.testing.assert_allclose(stroke[name], want, rtol=0, atol=1e-9, err_msg=name)
    assert lifts_of(stroke) == layout.lifts, said


def assert_path(stroke, layout):
    """The corners are there in their order, and where the tool lifts."""
    at = -1
    corners = []
    for corner in layout.p:
        far = np.abs(stroke["position"] - corner).max(axis=1)
        found = np.flatnonzero(far[at + 1:] < 1e-9)
        assert found.size, f"{corner} is not among {stroke['position']}"
        at += 1 + found[0]
        corners.append(at)
    assert corners[0] == 0 and corners[-1] == len(stroke["time"]) - 1
    assert lifts_of(stroke) == [corners[k] for k in layout.lifts]


@pytest.fixture
def motion():
    return Motion()
