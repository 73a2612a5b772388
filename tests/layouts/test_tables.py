"""Tables of text as real programs write them: their header lines, names, units, separators and rates, with own numbers."""
import datetime

import numpy as np
import pytest

from conftest import Layout, Motion, check

TABLES = {}


def table(ending):
    """Registers a function that writes a file with a motion and says what must be read."""
    def register(function):
        TABLES[function.__name__] = (ending, function)
        return function
    return register


def rows(columns, separator=",", end="", form=lambda value: f"{value:.12g}"):
    return "".join(separator.join(v if isinstance(v, str) else form(v) for v in row) + end + "\n"
                   for row in zip(*columns))


def columns(array, factor=1.0):
    return list((array * factor).T)


@table("csv")
def plain(file, m):
    file.write_text("t,x,y,z\n" + rows([m.t, *columns(m.p)]))
    return Layout(["--position-unit", "m", "--time-unit", "s"], t=m.t, p=m.p)


@table("csv")
def nothing_is_said_of_units(file, m):
    file.write_text("t,x,y,z\n" + rows([m.t * 1e3, *columns(m.p, 1e3)]))
    return Layout(asks=[("unit", ["--position-unit", "mm"]), ("unit", ["--time-unit", "ms"])], t=m.t, p=m.p)


@table("csv")
def serial_monitor_rows_end_in_a_comma(file, m):
    file.write_text("x [mm],y [mm],z [mm]\n" + rows(columns(m.p, 1e3), end=","))
    return Layout(["--rate", "100"], t=m.t, p=m.p)


@table("txt")
def serial_monitor_semicolons_and_names_given(file, m):
    file.write_text(rows([m.t * 1e3, *columns(m.p, 1e3)], separator=";", end=";"))
    return Layout(["--columns", "t,x,y,z", "--time-unit", "ms", "--position-unit", "mm"], t=m.t, p=m.p)


@table("csv")
def header_ends_in_commas_and_rows_do_not(file, m):
    file.write_text("t [s],x [mm],y [mm],z [mm],,\n" + rows([m.t, *columns(m.p, 1e3)]))
    return Layout(t=m.t, p=m.p)


@table("lvm")
def labview(file, m):
    file.write_text("LabVIEW Measurement\t\nWriter_Version\t2\nReader_Version\t2\nSeparator\tTab\nDecimal_Separator\t.\n"
                    "***End_of_Header***\t\nX_Value\tx_mm\ty_mm\tz_mm\tComment\n"
                    + rows([m.t, *columns(m.p, 1e3)], separator="\t", end="\t"))
    return Layout(["--skip-lines", "6", "--time", "X_Value", "--time-unit", "s", "--position", "x_mm,y_mm,z_mm"], t=m.t,
                  p=m.p)


@table("csv")
def pandas_with_its_index(file, m):
    file.write_text(",time_s,x_m,y_m,z_m\n" + rows([np.arange(m.n), m.t, *columns(m.p)]))
    return Layout(t=m.t, p=m.p)


@table("txt")
def r_write_table(file, m):
    """Row names, and one name less than there are columns."""
    names = [f'"{k + 1}"' for k in range(m.n)]
    file.write_text('"time_s" "x_mm" "y_mm" "z_mm"\n' + rows([names, m.t, *columns(m.p, 1e3)], separator=" "))
    return Layout(t=m.t, p=m.p)


@table("txt")
def numpy_savetxt(file, m):
    table = np.column_stack([m.t, m.p, m.f])
    np.savetxt(file, table, header="t x y z fx fy fz")
    return Layout(["--position-unit", "m", "--time-unit", "s", "--force-unit", "N", "--force-sign", "on device"], t=m.t,
                  p=m.p, f=m.f)


@table("csv")
def german_excel(file, m):
    comma = lambda value: f"{value:.9g}".replace(".", ",")
    text = "Zeit (ms);X (mm);Y (mm);Z (mm);Fx (N);Fy (N);Fz (N)\r\n" + rows(
        [m.t * 1e3, *columns(m.p, 1e3), *columns(m.f)], ";", "\r", comma)
    file.write_bytes(b"\xef\xbb\xbf" + text.encode())
    return Layout(["--force-sign", "by hand"], t=m.t, p=m.p)


@table("txt")
def excel_unicode_text(file, m):
    text = "t_ms\tx_mm\ty_mm\tz_mm\r\n" + rows([m.t * 1e3, *columns(m.p, 1e3)], "\t", "\r")
    file.write_bytes(b"\xff\xfe" + text.encode("utf-16-le"))
    return Layout(t=m.t, p=m.p)


@table("csv")
def dates(file, m):
    start = datetime.datetime(2024, 3, 31, 1, 59, 59, tzinfo=datetime.timezone.utc)
    stamps = [(start + datetime.timedelta(seconds=round(float(t), 6))).isoformat(timespec="milliseconds") for t in m.t]
    file.write_text("timestamp,x (m),y (m),z (m)\n" + rows([stamps, *columns(m.p)]))
    return Layout(t=m.t, p=m.p)


@table("csv")
def ten_hertz(file, _):
    """Its period is as long as what is a gap at 1 kHz."""
    m = Motion(n=200, rate=10)
    file.write_text("time_s,x_mm,y_mm,z_mm\n" + rows([m.t + 0.004 * (np.arange(m.n) % 3), *columns(m.p, 1e3)]))
    return Layout(t=m.t + 0.004 * (np.arange(m.n) % 3), p=m.p)


@table("csv")
def one_hertz_with_a_pause(file, _):
    m = Motion(n=60, rate=1)
    t = m.t + np.where(np.arange(m.n) >= 30, 100.0, 0.0)
    file.write_text("time_s,x_mm,y_mm,z_mm\n" + rows([t, *columns(m.p, 1e3)]))
    return Layout(t=t, p=m.p, lifts=[29])


@table("csv")
def optitrack_motive(file, m):
    """Names occur twice: X, Y, Z of the rotation and of the position."""
    file.write_text(
        "Format Version,1.23,Take Name,Take 1,Capture Frame Rate,100.000000,Export Frame Rate,100.000000,"
        "Rotation Type,Quaternion,Length Units,Meters,Coordinate Space,Global\n\n"
        ",,Rigid Body,Rigid Body,Rigid Body,Rigid Body,Rigid Body,Rigid Body,Rigid Body,Rigid Body\n"
        ",,Tool,Tool,Tool,Tool,Tool,Tool,Tool,Tool\n"
        ",,1,1,1,1,1,1,1,1\n"
        ",,Rotation,Rotation,Rotation,Rotation,Position,Position,Position,Mean Marker Error\n"
        "Frame,Time (Seconds),X,Y,Z,W,X,Y,Z,\n"
        + rows([np.arange(m.n), m.t, *columns(m.q), m.p[:, 0], m.p[:, 2], -m.p[:, 1], 1e-4 + 0 * m.t],
               form=lambda v: f"{v:.15g}"))
    return Layout(["--skip-lines", "6", "--position-unit", "m", "--orientation", "none"],
                  asks=[("(?s)numbers?", ["--position", "7,-9,8"])], t=m.t, p=m.p)


@table("csv")
def vicon_nexus(file, m):
    file.write_text("Trajectories\n100\n,,Tool:Tip,,\nFrame,Sub Frame,X,Y,Z\n,,mm,mm,mm\n"
                    + rows([np.arange(1, m.n + 1), 0 * m.t, *columns(m.p, 1e3)]))
    return Layout(["--skip-lines", "3", "--rate", "100"], t=m.t, p=m.p)


@table("tsv")
def qualisys(file, m):
    file.write_text(f"NO_OF_FRAMES\t{m.n}\nNO_OF_CAMERAS\t8\nNO_OF_MARKERS\t1\nFREQUENCY\t100\nNO_OF_ANALOG\t0\n"
                    "ANALOG_FREQUENCY\t0\nDESCRIPTION\t--\nTIME_STAMP\t2024-01-01\nDATA_INCLUDED\t3D\nMARKER_NAMES\tTip\n"
                    "Frame\tTime\tTip X\tTip Y\tTip Z\n"
                    + rows([np.arange(1, m.n + 1), m.t, *columns(m.p, 1e3)], "\t"))
    return Layout(["--skip-lines", "10", "--position-unit", "mm", "--time-unit", "s"], t=m.t, p=m.p)


@table("trc")
def opensim_trc(file, m):
    file.write_text(f"PathFileType\t4\t(X/Y/Z)\tmotion.trc\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\n"
                    f"100\t100\t{m.n}\t1\tmm\nFrame#\tTime\tTip\t\t\n\t\tX1\tY1\tZ1\n\n"
                    + rows([np.arange(1, m.n + 1), m.t, *columns(m.p, 1e3)], "\t"))
    return Layout(["--skip-lines", "4", "--separator", "tab", "--position-unit", "mm", "--rate", "100"], t=m.t, p=m.p)


@table("mot")
def opensim_mot(file, m):
    file.write_text("forces.mot\nversion=1\n" f"nRows={m.n}\nnColumns=7\ninDegrees=yes\nendheader\n"
                    "time\tground_force_vx\tground_force_vy\tground_force_vz\tground_force_px\tground_force_py\tground_force_pz\n"
                    + rows([m.t, *columns(m.f), *columns(m.p)], "\t"))
    return Layout(["--skip-lines", "6", "--position", "ground_force_px,ground_force_py,ground_force_pz", "--position-unit", "m",
                   "--force", "ground_force_vx,ground_force_vy,ground_force_vz", "--force-unit", "N", "--velocity", "none",
                   "--force-sign", "on device", "--time-unit", "s"], t=m.t, p=m.p, f=m.f)


CLOCK = 1711850399_000000000


def stamps_ns(m):
    return [str(CLOCK + int(round(t * 1e9))) for t in m.t]


@table("csv")
def rostopic_pose(file, m):
    pose = ",".join(f"field.pose.position.{a}" for a in "xyz") + "," + ",".join(f"field.pose.orientation.{a}" for a in "xyzw")
    file.write_text("%time,field.header.seq,field.header.stamp,field.header.frame_id," + pose + "\n"
                    + rows([stamps_ns(m), np.arange(m.n), stamps_ns(m), ["base"] * m.n, *columns(m.p), *columns(m.q)],
                           form=lambda v: f"{v:.15g}"))
    return Layout(asks=[("unit", ["--position-unit", "m"])], t=m.t, p=m.p, q=m.q)


@table("csv")
def rostopic_wrench_beside_a_pose(file, m):
    rostopic_pose(file, m)
    force = ",".join(f"field.wrench.force.{a}" for a in "xyz")
    (file.parent / "wrench.csv").write_text(
        f"%time,field.header.seq,field.header.stamp,{force}\n"
        + rows([stamps_ns(m), np.arange(m.n), stamps_ns(m), *columns(m.f)]))
    return Layout(["--position-unit", "m", "--merge", "wrench.csv", "--force-sign", "by hand"],
                  asks=[("wrench.csv.* unit", ["--force-unit", "N"])], t=m.t, p=m.p, q=m.q, f=m.f, asked="wrench.csv")


@table("csv")
def plotjuggler(file, m):
    file.write_text("__time,/tool/pose/position/x,/tool/pose/position/y,/tool/pose/position/z\n"
                    + rows([[f"{t:.6f}" for t in m.t], *columns(m.p)]))
    return Layout(["--position-unit", "m", "--time", "__time", "--time-unit", "s"], t=m.t, p=m.p)


@table("csv")
def seconds_and_nanoseconds(file, m):
    ns = [CLOCK + int(round(t * 1e9)) for t in m.t]
    file.write_text("header.stamp.sec,header.stamp.nanosec,pose.position.x,pose.position.y,pose.position.z\n"
                    + rows([[str(v // 10**9) for v in ns], [str(v % 10**9) for v in ns], *columns(m.p)]))
    return Layout(["--position-unit", "m"], t=m.t, p=m.p)


@table("csv")
def libfranka(file, m):
    """A pose is 16 numbers, column by column."""
    names = ",".join(f"O_T_EE[{k}]" for k in range(16))
    one, none = 1.0 + 0 * m.t, 0 * m.t
    pose = [one, none, none, none, none, one, none, none, none, none, one, none, *columns(m.p), one]
    file.write_text("time," + names + ",K_F_ext_hat_K[0],K_F_ext_hat_K[1],K_F_ext_hat_K[2]\n"
                    + rows([np.arange(m.n) * 10, *pose, *columns(m.f)]))
    return Layout(["--position", "O_T_EE[12],O_T_EE[13],O_T_EE[14]", "--position-unit", "m", "--time-unit", "ms", "--force",
                   "K_F_ext_hat_K[0],K_F_ext_hat_K[1],K_F_ext_hat_K[2]", "--force-unit", "N", "--force-sign", "by hand"],
                  t=m.t, p=m.p)


@table("csv")
def ur_rtde(file, m):
    names = ["timestamp"] + [f"actual_TCP_pose_{k}" for k in range(6)] + [f"actual_TCP_force_{k}" for k in range(6)]
    zero = [0 * m.t] * 3
    file.write_text(" ".join(names) + "\n" + rows([m.t, *columns(m.p), *zero, *columns(m.f), *zero], " "))
    return Layout(["--position", "actual_TCP_pose_0,actual_TCP_pose_1,actual_TCP_pose_2", "--position-unit", "m", "--time-unit",
                   "s", "--force", "actual_TCP_force_0,actual_TCP_force_1,actual_TCP_force_2", "--force-unit", "N",
                   "--force-sign", "on device"], t=m.t, p=m.p, f=m.f)


@table("txt")
def jigsaws(file, _):
    """76 columns of blanks, no header, 30 Hz."""
    m = Motion(n=120, rate=30)
    other = [0.5 + 0 * m.t] * 38
    file.write_text(rows([*other, *columns(m.p), *[0.25 + 0 * m.t] * 35], "   "))
    return Layout(["--position", "39,40,41", "--position-unit", "m", "--rate", "30"], t=np.arange(120) / 30, p=m.p)


@table("csv")
def ndi_polaris_loses_its_tool(file, m):
    """Cells are empty while the tool is hidden."""
    pose = columns(np.column_stack([m.q[:, 3], m.q[:, :3], m.p * 1e3]))
    state = ["OK"] * m.n
    for k in range(50, 60):
        state[k] = "MISSING"
    lines = rows([np.arange(m.n), state, m.t, *pose], form=lambda v: f"{v:.15g}").splitlines()
    for k in range(50, 60):
        lines[k] = ",".join(lines[k].split(",")[:3]) + ",,,,,,,"
    file.write_text("Frame,State,Time,Q0,Qx,Qy,Qz,Tx,Ty,Tz\n" + "\n".join(lines) + "\n")
    seen = np.r_[0:50, 60:m.n]
    return Layout(["--position", "Tx,Ty,Tz", "--position-unit", "mm", "--time-unit", "s", "--orientation", "Qx,Qy,Qz,Q0"],
                  t=m.t[seen], p=m.p[seen], q=m.q[seen], lifts=[49])


@table("csv")
def tracker_writes_nan(file, m):
    p = m.p.copy()
    p[100:105] = np.nan
    file.write_text("x (meters),y (meters),z (meters)\n" + rows(columns(p)))
    seen = np.r_[0:100, 105:m.n]
    return Layout(["--rate", "100"], t=m.t[seen], p=m.p[seen], lifts=[99])


@table("csv")
def unused_columns_are_empty(file, m):
    torque = ["" if k % 2 else "0.5" for k in range(m.n)]
    file.write_text("t_s,x_mm,y_mm,z_mm,torque_x,temperature\n" + rows([m.t, *columns(m.p, 1e3), torque, ["NaN"] * m.n]))
    return Layout(t=m.t, p=m.p)


@table("csv")
def units_in_a_row_of_words(file, m):
    file.write_text("Time,X,Y,Z,Fx,Fy,Fz\nSeconds,Millimeters,Millimeters,Millimeters,Newtons,Newtons,Newtons\n"
                    + rows([m.t, *columns(m.p, 1e3), *columns(m.f)]))
    return Layout(["--force-sign", "on device"], t=m.t, p=m.p, f=m.f)


@table("csv")
def long_names(file, m):
    file.write_text("Time (Milliseconds),X Position (mm),Y Position (mm),Z Position (mm)\n"
                    + rows([m.t * 1e3, *columns(m.p, 1e3)]))
    return Layout(t=m.t, p=m.p)


@table("csv")
def axis_first(file, m):
    file.write_text("time_s,x_pos,y_pos,z_pos\n" + rows([m.t, *columns(m.p)]))
    return Layout(asks=[("unit", ["--position-unit", "m"])], t=m.t, p=m.p)


@table("csv")
def unity(file, m):
    """y points up, and the axes are left-handed."""
    file.write_text("time,pos.x,pos.y,pos.z\n" + rows([m.t, m.p[:, 0], m.p[:, 2], m.p[:, 1]]))
    return Layout(["--position", "pos.x,pos.z,pos.y", "--position-unit", "m", "--time-unit", "s"], t=m.t, p=m.p)


@table("csv")
def inches_and_pounds(file, m):
    inches = np.round(m.p / 0.0254, 4)
    pounds = np.round(m.f, 2)
    file.write_text("t (sec),x (in),y (in),z (in),Fx (lbf),Fy (lbf),Fz (lbf)\n" + rows([m.t, *columns(inches), *columns(pounds)]))
    return Layout(["--force-sign", "on device"], t=m.t, p=inches * 0.0254, f=pounds * 4.4482216152605)


@table("csv")
def load_cell_in_counts(file, m):
    counts = np.round(m.f * 1000)
    file.write_text("t (s),x (mm),y (mm),z (mm),Fx,Fy,Fz\n" + rows([m.t, *columns(m.p, 1e3), *columns(counts)]))
    return Layout(["--force-unit", "0.0025", "--force-sign", "on device"], t=m.t, p=m.p, f=counts * 0.0025)


@table("csv")
def pixels_beside_metres(file, m):
    file.write_text("t,x,y,X,Y,Z\n" + rows([m.t, 400 + 10 * np.arange(m.n) % 7, 300 + 0 * m.t, *columns(m.p)]))
    return Layout(["--position-unit", "m", "--time-unit", "s"], asks=[("'?x'?.*'?X'?", ["--position", "X,Y,Z"])], t=m.t, p=m.p)


@table("csv")
def strokes_are_numbered(file, m):
    p = np.column_stack([m.p[:, :2], 0 * m.t])
    stroke = np.where(np.arange(m.n) < 90, 1, 2)
    file.write_text("stroke,t,x,y\n" + rows([stroke, m.t * 1e3, *columns(p[:, :2], 1e3)]))
    return Layout(["--position-unit", "mm", "--time-unit", "ms"], t=m.t, p=p, lifts=[89])


@table("csv")
def pen_is_up_between(file, m):
    p = np.column_stack([m.p[:, :2], 0 * m.t])
    pen = np.ones(m.n, int)
    pen[90:110] = 0
    file.write_text("t,x,y,pen_down\n" + rows([m.t * 1e3, *columns(p[:, :2], 1e3), pen]))
    return Layout(["--position-unit", "mm", "--time-unit", "ms"], t=m.t, p=p, lifts=list(range(89, 110)))


@table("txt")
def svc2004(file, m):
    """Signatures: a count, then x y stamp button azimuth altitude pressure."""
    x, y = np.round(5000 + m.p[:, 0] * 1e5), np.round(5000 + m.p[:, 1] * 1e5)
    file.write_text(f"{m.n}\n" + rows([x, y, m.t * 1e3, 1 + 0 * m.t, 1500 + 0 * m.t, 500 + 0 * m.t, 300 + 0 * m.t], " "))
    return Layout(["--skip-lines", "1", "--columns", "x,y,t,button,azimuth,altitude,pressure", "--position-unit", "1e-5",
                   "--time-unit", "ms"], t=m.t, p=np.column_stack([x, y, 0 * x]) * 1e-5, pressure=300 + 0 * m.t)


@table("txt")
def omniglot(file, m):
    """Lines START and BREAK stand between strokes."""
    lines = rows([*columns(m.p[:, :2], 1e3), m.t * 1e3]).splitlines()
    file.write_text("\n".join(["START", *lines[:80], "BREAK", *lines[80:], "BREAK"]) + "\n")
    return Layout(["--columns", "x,y,t", "--skip", "START", "--pen-up", "BREAK", "--position-unit", "mm", "--time-unit", "ms"],
                  t=m.t, p=np.column_stack([m.p[:, :2], 0 * m.t]), lifts=[79])


@table("txt")
def chai3d_logger(file, m):
    file.write_text("# recorded with a device\n# t x y z fx fy fz\n" + rows([m.t, *columns(m.p), *columns(m.f)], " "))
    return Layout(["--time-unit", "s", "--position-unit", "m", "--force-unit", "N", "--force-sign", "on device"], t=m.t, p=m.p,
                  f=m.f)


@table("csv")
def clock_of_the_computer(file, m):
    """A clock and --rate disagree: both are named."""
    file.write_text("t_s,x_mm,y_mm,z_mm\n" + rows([m.t, *columns(m.p, 1e3)]))
    return Layout(["--rate", "500"], t=np.arange(m.n) / 500, p=m.p, says="2.39")


@table("csv")
def velocity_in_other_units(file, m):
    """The recorded velocity is a thousand times the change of the positions."""
    v = np.gradient(m.p, m.t, axis=0) * 1e3
    file.write_text("t_s,x_mm,y_mm,z_mm,vx_m/s,vy_m/s,vz_m/s\n" + rows([m.t, *columns(m.p, 1e3), *columns(v)]))
    return Layout(t=m.t, p=m.p, says="times the speed of position")


@pytest.mark.parametrize("name", TABLES)
def test_is_read_as_it_was_meant(name, motion, tmp_path):
    ending, write = TABLES[name]
    file = tmp_path / f"{name}.{ending}"
    check(write(file, motion), file, tmp_path)
