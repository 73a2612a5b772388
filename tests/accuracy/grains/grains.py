"""Turns dumps of grains into heights, sections, slopes and forces. Lengths in mm, forces in N."""
import numpy as np

RASTER = 0.25  # mm, of the upper envelope


def load(name):
    """x, y, z, radius [mm] of a dump, moved into the box, and the box's lengths along x and y."""
    with open(name) as file:
        lines = [next(file) for _ in range(9)]
        rows = np.loadtxt(file) * 1e3
    low, high = np.array([line.split()[:2] for line in lines[5:7]], float).T * 1e3
    length = high - low
    rows[:, :2] = (rows[:, :2] - low) % length
    return rows.T, length


def envelope(name):
    """The highest point of any grain over each place of a raster [mm]."""
    (x, y, z, radius), length = load(name)
    count = np.round(length / RASTER).astype(int)
    step = length / count
    column, row = (x / step[0]).astype(int), (y / step[1]).astype(int)
    height = np.zeros(count)
    reach = int(np.ceil(radius.max() / RASTER)) + 1
    for i in range(-reach, reach + 1):
        for j in range(-reach, reach + 1):
            apart = ((column + i + 0.5) * step[0] - x) ** 2 + ((row + j + 0.5) * step[1] - y) ** 2
            hit = apart < radius**2
            place = (column[hit] + i) % count[0], (row[hit] + j) % count[1]
            np.maximum.at(height, place, z[hit] + np.sqrt(radius[hit] ** 2 - apart[hit]))
    return height, step


def tops(shape, size, apart_x, apart_y, z, radius):
    """How high a tool's lowest point is where it touches each grain, so far from its axis [mm]."""
    far = np.hypot(apart_x, apart_y)
    if shape == "sphere":
        return np.where(far < size, z + np.sqrt(np.maximum((size + radius) ** 2 - far**2, 0.0)) - size, -np.inf)
    if shape == "cone":  # flanks of 45 degrees
        tip = z + np.sqrt(np.maximum(radius**2 - far**2, 0.0))
        return np.where(far < radius / np.sqrt(2.0), tip, z + radius * np.sqrt(2.0) - far)
    if shape == "plate":
        over = np.maximum(far - size, 0.0)
    else:  # blade
        over = np.hypot(np.maximum(np.abs(apart_x) - 2.0, 0.0), np.maximum(np.abs(apart_y) - size, 0.0))
    return np.where(over < radius, z + np.sqrt(np.maximum(radius**2 - over**2, 0.0)), -np.inf)


def first_touch(grains, length, shape, size, places, y):
    """How high the lowest point of a tool is where it first touches the bed, at each x of places [mm]."""
    x, y_of, z, radius = grains
    high = z > z.max() - 6.0
    x, y_of, z, radius = x[high], y_of[high], z[high], radius[high]
    apart_y = (y_of - y + length[1] / 2) % length[1] - length[1] / 2
    return np.array([tops(shape, size, (x - at + length[0] / 2) % length[0] - length[0] / 2, apart_y, z, radius).max()
                     for at in places])


def solid_share(name, low=4.0, high=12.0):
    """Share of grains in the volume between two heights."""
    (_, _, z, radius), length = load(name)
    heights = np.arange(low, high, 0.1) + 0.05
    cut = [np.pi * np.maximum(radius**2 - (at - z) ** 2, 0.0).sum() for at in heights]
    return np.mean(cut) / length.prod()


def _parts(change, distance, parts, width):
    """Means of the change in bins of the distance, over all parts; and their standard error, from the parts."""
    bins = np.arange(0.0, 28.0, width)
    means = [[change[part & (distance >= at) & (distance < at + width)].mean() for at in bins] for part in parts]
    return bins + width / 2, np.mean(means, 0), np.std(means, 0, ddof=1) / np.sqrt(len(means))


def _places(shape, step):
    """x and y from the bed's middle of each place of a raster [mm]."""
    x = (np.arange(shape[0]) + 0.5) * step[0]
    y = (np.arange(shape[1]) + 0.5) * step[1] - shape[1] * step[1] / 2
    return np.meshgrid(x, y, indexing="ij")


def section(before, after, step, low, high, width=2.0):
    """Across a drag along x, between low and high [mm]: both sides, in four stretches each."""
    x, y = _places(before.shape, step)
    edges = np.linspace(low, high, 5)
    parts = [(x >= start) & (x < end) & (side * y > 0) for start, end in zip(edges, edges[1:]) for side in (-1, 1)]
    return _parts(after - before, np.abs(y), parts, width)


def crater(before, after, step, at, _, width=2.0):
    """Around a plunge at x = at [mm], in four quarters. (A bed that is periodic along x: what lies beyond its end.)"""
    x, y = _places(before.shape, step)
    length = before.shape[0] * step[0]
    x = (x - at + length / 2) % length - length / 2
    parts = [(one * x > 0) & (two * y > 0) for one in (-1, 1) for two in (-1, 1)]
    return _parts(after - before, np.hypot(x, y), parts, width)


def above_over_below(before, after, block=8):
    """Of the whole bed: the volume that is higher than before, over that which is lower. Means over blocks of 2 mm, for
    grains that change places make no volume."""
    change = after - before
    rows, columns = (count // block * block for count in change.shape)
    change = change[:rows, :columns].reshape(rows // block, block, columns // block, block).mean((1, 3))
    return change[change > 0].sum() / -change[change < 0].sum()


def of_section(middle, change):
    """Area of the groove and of the levees on both sides [mm^2], the levee's height and place [mm]."""
    width = middle[1] - middle[0]
    peak = change.argmax()
    return (-2 * width * change[:peak][change[:peak] < 0].sum(), 2 * width * change[change > 0].sum(),
            change[peak], middle[peak])
