"""Opens an XDMF file as ParaView does, says what it saw, and draws it warped by its height.

usage: paraview_opens.py READER FILE.xdmf [PICTURE.png]   READER: default, or a reader's name in paraview.simple
"""
import json
import sys

import paraview.simple as simple


def open_file(reader, path):
    if reader == "default":
        return simple.OpenDataFile(path)
    if reader == "XDMFReader":
        return simple.XDMFReader(FileNames=[path])
    return getattr(simple, reader)(FileName=path)


source = open_file(sys.argv[1], sys.argv[2])
steps = []
for time in source.TimestepValues:
    source.UpdatePipeline(time)
    data = source.GetDataInformation()
    height = data.GetPointDataInformation().GetArrayInformation("height")
    low, high = (height.GetComponentRange(0)[end] for end in (0, 1))
    steps.append({"time": time, "bounds": data.GetBounds(), "low": low, "high": high})
print(json.dumps({"reader": type(source).__name__, "steps": steps}))

if len(sys.argv) > 3:
    warped = simple.WarpByScalar(Input=source)
    warped.Scalars = ["POINTS", "height"]
    warped.ScaleFactor = 10
    view = simple.CreateView("RenderView")
    view.ViewSize = [640, 480]
    view.ViewTime = source.TimestepValues[-1]
    view.OrientationAxesVisibility = 0
    view.Background = [0, 0, 0]
    simple.ColorBy(simple.Show(warped, view), ("POINTS", "height"))
    view.ResetCamera()
    simple.GetActiveCamera().Elevation(-50)
    simple.Render(view)
    simple.SaveScreenshot(sys.argv[3], view)
