#!/usr/bin/python3
"""touch.py DUMP SHAPE R [SHIFT]: where a tool first touches a bed, mean and scatter along its stroke [mm]; before
a stroke, to tell it where depth 0 is."""
import sys

import numpy as np

import grains

dump, shape, size = sys.argv[1], sys.argv[2], float(sys.argv[3])
shift = float(sys.argv[4]) if len(sys.argv) > 4 else 0.0
(x, y, z, radius), length = grains.load(dump)
places = np.arange(0.0, length[0], 0.5)
touch = grains.first_touch((x, y + shift, z, radius), length, shape, size, places, length[1] / 2)
height = grains.envelope(dump)[0]
print(f"{touch.mean():.3f} +- {touch.std():.3f}, {touch.mean() - height.mean():.3f} over the mean envelope; "
      f"solid share {grains.solid_share(dump):.3f}")
