"""Opens the groups of a run file or stroke as xarray does, and its frames as h5py does; says what it saw.

usage: xarray_opens.py FILE.h5 GROUP...   one line of JSON for each group
"""
import json
import sys

import h5py
import numpy
import xarray


def seen(path, group):
    data = xarray.open_dataset(path, engine="h5netcdf", group=group)
    variables = {}
    for name, variable in data.variables.items():
        variables[name] = {"dims": variable.dims, "kind": variable.dtype.kind,
                           "attrs": {key: str(value) for key, value in variable.attrs.items()}}
        if variable.dtype.kind in "fiu" and variable.size:
            variables[name]["least"] = float(numpy.nanmin(variable.values))
            variables[name]["greatest"] = float(numpy.nanmax(variable.values))
    return {"variables": variables, "attrs": {key: str(value) for key, value in data.attrs.items()}}


for group in sys.argv[2:]:
    print(json.dumps(seen(sys.argv[1], group)))
with h5py.File(sys.argv[1]) as file:
    if "/surface/frames" in file:
        frames = file["/surface/frames"]
        heights = [frames[k] for k in range(len(frames))]
        assert all(numpy.isfinite(h).all() for h in heights)
        assert (heights[0] == file["/surface/initial"][:]).all()
        for k in range(1, len(frames)):  # what changed is as it was written, the rest as in the frame before
            changed = file[f"/surface/frame/{k:06}/changed"][:]
            expected = numpy.where(numpy.isnan(changed), heights[k - 1], changed)
            assert (heights[k] == expected).all(), k
