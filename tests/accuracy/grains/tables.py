#!/usr/bin/python3
"""tables.py FOLDER: makes the tables beside this file from what `run FOLDER` left."""
import csv
import sys
from pathlib import Path

import numpy as np

import grains

HERE = Path(__file__).parent
START = 15.0  # mm, x of a drag's start and of a plunge
FROM, TO = 20.0, 37.0  # mm from there: where drags are measured
STRETCH = 8.5  # mm, of the way, for what is not steady yet
# name: bed, shape, R, depth, way, shift [mm]; as in `run`. Of a stroke with more than one pass the last is measured.
STROKES = {
    "sphere-2-a": (1, "sphere", 10.0, 2.0, 45.0, 0.0),
    "sphere-4-a": (1, "sphere", 10.0, 4.0, 45.0, 0.0),
    "sphere-6-a": (1, "sphere", 10.0, 6.0, 45.0, 0.0),
    "plunge-6-a": (1, "sphere", 10.0, 6.0, 0.0, 0.0),
    "plunge-6-b": (2, "sphere", 10.0, 6.0, 0.0, 14.0),
    "again-4-a": (1, "sphere", 10.0, 4.0, 45.0, 0.0),
    "again-4-b": (2, "sphere", 10.0, 4.0, 45.0, 14.0),
    "blade-4-a": (1, "blade", 10.0, 4.0, 45.0, 0.0),
    "blade-4-b": (2, "blade", 10.0, 4.0, 45.0, 14.0),
    "cone-6-a": (1, "cone", 10.0, 6.0, 0.0, 0.0),
    "cone-6-b": (2, "cone", 10.0, 6.0, 0.0, 14.0),
    "plate-4-a": (1, "plate", 10.0, 4.0, 0.0, 0.0),
    "plate-4-b": (2, "plate", 10.0, 4.0, 0.0, 14.0),
    "sphere-2-b": (2, "sphere", 10.0, 2.0, 45.0, 14.0),
    "sphere-4-b": (2, "sphere", 10.0, 4.0, 45.0, 14.0),
    "sphere-6-b": (2, "sphere", 10.0, 6.0, 45.0, 14.0),
}


def write(name, header, rows):
    with open(HERE / name, "w", newline="") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(header)
        out.writerows([[f"{one:.4g}" if isinstance(one, float) else one for one in row] for row in rows])


def talus(name):
    """Slopes [deg] of the flanks of a slot that slumped, in four strips along it."""
    height, step = grains.envelope(name)
    y = (np.arange(height.shape[1]) + 0.5) * step[1]
    slopes = []
    for strip in np.array_split(height, 4):
        profile = strip.mean(0)
        middle = len(profile) // 2
        valley = middle - 40 + profile[middle - 40:middle + 40].argmin()
        low, top = profile[valley], np.quantile(profile, 0.9)
        for flank in (slice(0, valley), slice(valley, None)):
            part, at = profile[flank], y[flank]
            within = (part > low + 0.2 * (top - low)) & (part < low + 0.8 * (top - low))
            slopes.append(abs(np.degrees(np.arctan(np.polyfit(at[within], part[within], 1)[0]))))
    return np.mean(slopes), np.std(slopes, ddof=1)


def touch_along(folder, name):
    """Where the tool of a stroke first touches its bed: mean height along the bed, which is its zero, the scatter, and
    how much higher it touches where it goes down [mm]."""
    bed, shape, size, _, _, shift = STROKES[name]
    (x, y, z, radius), length = grains.load(folder / f"bed{bed}.bed")
    along = [grains.first_touch((x, y + shift, z, radius), length, shape, size, places, length[1] / 2)
             for places in (np.arange(0.0, length[0], 0.5), [START])]
    return along[0].mean(), along[0].std(), along[1][0] - along[0].mean()


def main(folder):
    sections, forces, strokes, stretches, plunges, beds = [], [], [], [], [], []
    for bed in (1, 2):
        if not (folder / f"bed{bed}.bed").exists():
            continue
        slope = talus(folder / f"slot{bed}.after") if (folder / f"slot{bed}.after").exists() else ("", "")
        beds.append([bed, grains.solid_share(folder / f"bed{bed}.bed"),
                     grains.envelope(folder / f"bed{bed}.bed")[0].mean(), *slope])
    for name, (bed, shape, size, depth, way, _) in STROKES.items():
        if not (folder / f"{name}.after").exists():
            continue
        before, step = grains.envelope(folder / f"{name}.before")
        after, _ = grains.envelope(folder / f"{name}.after")
        measure = grains.section if way > 0.0 else grains.crater
        middle, change, error = measure(before, after, step, START + FROM if way > 0.0 else START, START + TO)
        sections += [[name, float(at), float(one), float(off)] for at, one, off in zip(middle, change, error)]
        groove = grains.of_section(middle, change) if way > 0.0 else [""] * 4
        strokes.append([name, bed, shape, size, depth, *touch_along(folder, name), *groove,
                        grains.above_over_below(before, after)])
        dx, deep, fx, _, fz, of = np.loadtxt(folder / f"{name}.force").T[2:]
        dx, deep, fx, fz = (one[of == of.max()] for one in (dx * 1e3, deep * 1e3, fx, fz))
        sinks = np.diff(deep, prepend=-1.0) > 0.19  # 0.2 mm from record to record
        counts = (dx > FROM) & (dx < TO) if way > 0.0 else sinks & (deep > depth - 0.4)
        forces.append([name, fx[counts].mean(), fx[counts].std(), -fz[counts].mean(), fz[counts].std()])
        for low in np.arange(FROM - STRETCH, way - STRETCH - 7.9, STRETCH):  # the tool rests on the last 8 mm
            on_it = (dx > low) & (dx < low + STRETCH)
            part = grains.section(before, after, step, START + low, START + low + STRETCH)[:2]
            stretches.append([name, float(low), float(low + STRETCH), *grains.of_section(*part)[:3], fx[on_it].mean(),
                              -fz[on_it].mean()])
        if way == 0.0:  # drags begin in the same place
            for at in np.arange(1.0, depth + 0.1, 1.0):
                near = sinks & (np.abs(deep - at) < 0.31)
                if near.any():
                    plunges.append([name, float(at), -fz[near].mean()])
    write("beds.csv", ["bed", "solid_share", "mean_envelope_mm", "talus_deg", "talus_sd_deg"], beds)
    write("strokes.csv", ["stroke", "bed", "shape", "R_mm", "depth_mm", "zero_mm", "zero_sd_mm",
                          "touch_at_start_over_zero_mm", "groove_mm2", "levees_mm2", "levee_mm",
                          "levee_place_mm", "above_over_below"], strokes)
    write("sections.csv", ["stroke", "distance_mm", "change_mm", "standard_error_mm"], sections)
    write("forces.csv", ["stroke", "against_N", "against_sd_N", "up_N", "up_sd_N"], forces)
    write("stretches.csv", ["stroke", "from_mm", "to_mm", "groove_mm2", "levees_mm2", "levee_mm", "against_N", "up_N"],
          stretches)
    write("plunges.csv", ["stroke", "depth_mm", "up_N"], plunges)


main(Path(sys.argv[1]))
