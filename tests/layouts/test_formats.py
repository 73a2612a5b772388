"""Files of formats that know their columns, written by libraries of others or by hand, with own numbers."""
import math
import sqlite3
import struct

import numpy as np
import pytest

from conftest import Layout, check, needs

h5py, scipy_io = needs("h5py"), needs("scipy.io")

FORMATS = {}


def file_of(ending):
    def register(function):
        FORMATS[function.__name__] = (ending, function)
        return function
    return register


@file_of("mat")
def matlab_5(file, m):
    scipy_io.savemat(file, {"t": m.t[:, None], "pos": m.p * 1e3, "f": m.f})
    return Layout(["--position-unit", "mm", "--time-unit", "s", "--force-unit", "N", "--force-sign", "on device"], t=m.t, p=m.p,
                  f=m.f)


@file_of("mat")
def matlab_with_unseen_samples(file, m):
    p, torque = m.p * 1e3, m.f * np.nan
    p[40:44] = np.nan
    scipy_io.savemat(file, {"pos": p, "torque": torque})
    seen = np.r_[0:40, 44:m.n]
    return Layout(["--position-unit", "mm", "--rate", "100"], t=m.t[seen], p=m.p[seen], lifts=[39])


def matlab_7_3(file, variables):
    """As MATLAB writes: a user block of 512 bytes, classes as attributes, dimensions in turn."""
    with h5py.File(file, "w", userblock_size=512) as f:
        for name, value in variables.items():
            f[name] = value.T if value.ndim > 1 else value[None, :]
            f[name].attrs["MATLAB_class"] = np.bytes_("double")
    with open(file, "r+b") as f:
        f.write(b"MATLAB 7.3 MAT-file, Platform: GLNXA64, Created on: Mon Jan  1 00:00:00 2024".ljust(124) + b"\x00\x02IM")


@file_of("mat")
def matlab_73(file, m):
    matlab_7_3(file, {"t": m.t, "pos": m.p * 1e3})
    return Layout(["--position-unit", "mm", "--time-unit", "s"], t=m.t, p=m.p)


@file_of("npy")
def numpy_fields(file, m):
    table = np.zeros(m.n, [("t", "f8"), ("x", "f8"), ("y", "f8"), ("z", "f8"), ("n", "i4")])
    table["t"], table["x"], table["y"], table["z"] = m.t, *m.p.T
    np.save(file, table)
    return Layout(["--position-unit", "m", "--time-unit", "s"], t=m.t, p=m.p)


@file_of("npy")
def numpy_matrix(file, m):
    np.save(file, np.asfortranarray(np.column_stack([m.t, m.p])))
    return Layout(["--time", "1", "--position", "2,3,4", "--position-unit", "m", "--time-unit", "s"], t=m.t, p=m.p)


@file_of("npz")
def numpy_archive(file, m):
    np.savez_compressed(file, t=m.t, pos=m.p, frames=np.zeros((3, 3)))
    return Layout(["--position-unit", "m", "--time-unit", "s"], asks=[("differ in length", ["--part", "pos"])], t=m.t, p=m.p)


@file_of("thr")
def sisyphus(file, m):
    """Sand tables: angle and radius; 0 points up, and turns clockwise."""
    theta = np.array([0, math.pi / 2, math.pi])
    file.write_text("# track\n" + "".join(f"{a:.12g} {r:.12g}\n" for a, r in zip(theta, [1, 1, 1])))
    return Layout(["--position-unit", "0.1", "--speed", "0.05"], path=True,
                  p=np.array([[0, 0.1, 0], [0.1, 0, 0], [0, -0.1, 0]]))


SQUARE = np.array([[10, 10, 0], [30, 10, 0], [30, 25, 0], [10, 25, 0]]) * 1e-3


@file_of("gcode")
def plotter_with_a_servo(file, _):
    file.write_text("G21\nG90\nM201 X500 Y500 Z100\nM3 S30\nG1 X10 Y10 F3000\nM3 S90\nG1 X30 Y10\nX30 Y25\nM3 S30\nG1 X40 Y40\n"
                    "G1 X10 Y25\nM3 S90\nG1 X10 Y10\nM3 S30\nM2\nG1 X99 Y99\n")
    corners = np.array([[10, 10, 0], [30, 10, 0], [30, 25, 0], [10, 25, 0], [10, 10, 0]]) * 1e-3
    return Layout(["--speed", "0.05"], asks=[("S30|S90", ["--pen-up", "M3 S30"])], path=True, p=corners, lifts=[2])


@file_of("nc")
def fusion_post(file, _):
    file.write_text("%\n(1001)\nG90 G94 G17 G49 G40 G80\nG21\nG28 G91 Z0\nG90\nT1 M6\nS5000 M3\nG54\nG0 X10 Y10\nG43 Z15 H1\n"
                    "G1 Z-1 F100\nX30\nY25\nX10\nG0 Z15\nM5\nG28 G91 Z0\nG90\nG28 X0 Y0\nM30\n%\n")
    return Layout(["--speed", "0.05"], path=True, p=SQUARE - [0, 0, 0.001])


@file_of("inkml")
def ink_in_centimetres(file, m):
    """y points down, as in all ink."""
    points = ", ".join(f"{x:.9g} {-y:.9g}" for x, y in m.p[:, :2] * 100)
    file.write_text('<ink xmlns="http://www.w3.org/2003/InkML"><definitions><context xml:id="c"><inkSource xml:id="s">'
                    '<traceFormat><channel name="X" type="decimal" units="cm"/><channel name="Y" type="decimal" units="cm"/>'
                    f'</traceFormat></inkSource></context></definitions><trace contextRef="#c">{points}</trace></ink>')
    return Layout(["--rate", "100"], t=m.t, p=np.column_stack([m.p[:, :2], 0 * m.t]))


@file_of("svg")
def drawing(file, _):
    file.write_text('<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="50mm" viewBox="0 0 200 100">'
                    '<g transform="translate(20,10)"><path d="M0 0 h40 v30 h-40 z m100 0 l20 20"/></g></svg>')
    corners = np.array([[10, -5, 0], [30, -5, 0], [30, -20, 0], [10, -20, 0], [10, -5, 0], [60, -5, 0], [70, -15, 0]]) * 1e-3
    return Layout(["--speed", "0.05", "--position", "x,y"], path=True, p=corners, lifts=[4])


@file_of("plt")
def hpgl(file, _):
    file.write_text("IN;SP1;PU400,400;PD1200,400,1200,1000,400,1000;PU2000,2000;PD2400,2000;PU;SP0;\n")
    corners = np.vstack([SQUARE, [[0.05, 0.05, 0], [0.06, 0.05, 0]]])
    return Layout(["--speed", "0.05"], path=True, p=corners, lifts=[3])


def pose_stamped(ns, p, q):
    """geometry_msgs/PoseStamped in CDR, little-endian."""
    frame = b"base\0"
    body = struct.pack("<iII", ns // 10**9, ns % 10**9, len(frame)) + frame
    body += b"\0" * (-len(body) % 8)
    return b"\0\1\0\0" + body + struct.pack("<7d", *p, *q)


CLOCK = 1711850399_000000000


@file_of("db3")
def ros2_bag(file, m):
    bag = sqlite3.connect(file)
    bag.execute("CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT, serialization_format TEXT,"
                " offered_qos_profiles TEXT)")
    bag.execute("CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, data BLOB)")
    bag.execute("INSERT INTO topics VALUES(1, '/tool', 'geometry_msgs/msg/PoseStamped', 'cdr', '')")
    for k in range(m.n):
        ns = CLOCK + int(round(m.t[k] * 1e9))
        bag.execute("INSERT INTO messages VALUES(?, 1, ?, ?)", (k, ns, pose_stamped(ns, m.p[k], m.q[k])))
    bag.commit()
    bag.close()
    return Layout(t=m.t, p=m.p, q=m.q)


def mcap_record(op, content):
    return struct.pack("<BQ", op, len(content)) + content


def mcap_text(text):
    return struct.pack("<I", len(text)) + text.encode()


@file_of("mcap")
def mcap_without_an_index(file, m):
    """A recording that was cut off after its last message: neither chunks nor a summary."""
    data = b"\x89MCAP0\r\n" + mcap_record(1, mcap_text("ros2") + mcap_text("by hand"))
    definition = b"std_msgs/Header header\ngeometry_msgs/Pose pose\n"
    data += mcap_record(3, struct.pack("<H", 1) + mcap_text("geometry_msgs/msg/PoseStamped") + mcap_text("ros2msg")
                        + struct.pack("<I", len(definition)) + definition)
    data += mcap_record(4, struct.pack("<HH", 1, 1) + mcap_text("/tool") + mcap_text("cdr") + struct.pack("<I", 0))
    for k in range(m.n):
        ns = CLOCK + int(round(m.t[k] * 1e9))
        data += mcap_record(5, struct.pack("<HIQQ", 1, k, ns, ns) + pose_stamped(ns, m.p[k], m.q[k]))
    file.write_bytes(data)
    return Layout(t=m.t, p=m.p, q=m.q)


@pytest.mark.parametrize("name", FORMATS)
def test_is_read_as_it_was_meant(name, motion, tmp_path):
    ending, write = FORMATS[name]
    file = tmp_path / f"{name}.{ending}"
    check(write(file, motion), file, tmp_path)
