"""Single ticks of force.law = "rft" in flat sand, against three-dimensional resistive force theory as it was published:
Agarwal, Goldman, Kamrin (PNAS 120, 2023), equations 6 to 8 and table 1, in angles, summed over exact surfaces."""
import os
import pathlib
import subprocess
import sys

import pytest

sys.path.append(str(pathlib.Path(__file__).parents[1]))
from needs import needs  # noqa: E402

np = needs("numpy")

DENSITY, FRICTION_ANGLE, TOOL_FRICTION, GRAVITY = 1560.0, 30.0, 0.4, 9.81

#: rows f1, f2, f3; columns 1, x1, x2, x3, x1^2, x2^2, x3^2, x1 x2, x2 x3, x3 x1, x1^3, x2^3, x3^3, x1 x2^2, x2 x1^2,
#: x2 x3^2, x3 x2^2, x3 x1^2, x1 x3^2, x1 x2 x3
TABLE_1 = np.array([
    [0.00212, -0.02320, -0.20890, -0.43083, -0.00259, 0.48872, -0.00415, 0.07204, -0.02750, -0.08772,
     0.01992, -0.45961, 0.40799, -0.10107, -0.06576, 0.05664, -0.09269, 0.01892, 0.01033, 0.15120],
    [-0.06796, -0.10941, 0.04725, -0.06914, -0.05835, -0.65880, -0.11985, -0.25739, -0.26834, 0.02692,
     -0.00736, 0.63758, 0.08997, 0.21069, 0.04748, 0.20406, 0.18519, 0.04934, 0.13527, -0.33207],
    [-0.02634, -0.03436, 0.45256, 0.00835, 0.02553, -1.31290, -0.05532, 0.06790, -0.16404, 0.02287,
     0.02927, 0.95406, -0.00131, -0.11028, 0.01487, -0.02730, 0.10911, -0.04097, 0.07881, -0.27519]])


def resistance():
    mu = np.tan(np.radians(FRICTION_ANGLE))
    return DENSITY * GRAVITY * (894 * mu**3 - 386 * mu**2 + 89 * mu)


def stress(normals, direction):
    """Over resistance and depth. The plate's tilt is -90 to 90 degrees, so one that looks up is its other side."""
    n = np.where(normals[:, 2:] > 1e-12, -normals, normals)
    # The frame of the theory: the motion lies in the plane of r and z, gamma below the horizontal.
    level = np.hypot(direction[0], direction[1])
    r = np.array([direction[0], direction[1], 0.0]) / level if level > 1e-12 else np.array([1.0, 0.0, 0.0])
    theta = np.cross([0.0, 0.0, 1.0], r)
    gamma = np.arctan2(-direction[2], level)
    beta = np.arccos(np.clip(-n[:, 2], -1, 1))
    psi = np.arctan2(n @ theta, n @ r)
    x1 = np.full(len(n), np.sin(gamma))
    x2 = np.cos(beta)
    x3 = np.cos(psi) * np.cos(gamma) * np.sin(beta) + np.sin(gamma) * np.cos(beta)
    powers = np.stack([1 + 0 * x1, x1, x2, x3, x1**2, x2**2, x3**2, x1 * x2, x2 * x3, x3 * x1, x1**3, x2**3, x3**3,
                       x1 * x2**2, x2 * x1**2, x2 * x3**2, x3 * x2**2, x3 * x1**2, x1 * x3**2, x1 * x2 * x3])
    f1, f2, f3 = TABLE_1 @ powers
    alpha = (np.outer(f1 * np.sin(beta) * np.cos(psi) + f2 * np.cos(gamma), r)
             + np.outer(f1 * np.sin(beta) * np.sin(psi), theta)
             + np.outer(-f1 * np.cos(beta) - f2 * np.sin(gamma) - f3, [0.0, 0.0, 1.0]))
    across = np.sum(alpha * n, axis=1)[:, None] * n
    along = alpha - across
    most = TOOL_FRICTION * np.linalg.norm(across, axis=1)
    size = np.linalg.norm(along, axis=1)
    return across + along * np.minimum(1.0, most / np.maximum(size, 1e-300))[:, None]


def middles(low, high, count):
    return low + (high - low) * (np.arange(count) + 0.5) / count


def disk(radius, z, sign, count=60):
    """A level disk: positions, normals, areas."""
    r, a = np.meshgrid(middles(0, radius, count), middles(0, 2 * np.pi, 4 * count))
    r, a = r.ravel(), a.ravel()
    return (np.column_stack([r * np.cos(a), r * np.sin(a), np.full(r.shape, z)]),
            np.tile([0.0, 0.0, sign], (len(r), 1)), r * (radius / count) * (2 * np.pi / (4 * count)))


def mantle(radius_of, low, high, slope, count=200):
    """A body of revolution's side; slope is dr/dz."""
    z, a = np.meshgrid(middles(low, high, count), middles(0, 2 * np.pi, 240))
    z, a = z.ravel(), a.ravel()
    r, dr = radius_of(z), slope(z)
    n = np.column_stack([np.cos(a), np.sin(a), -dr]) / np.sqrt(1 + dr**2)[:, None]
    area = r * np.sqrt(1 + dr**2) * ((high - low) / count) * (2 * np.pi / 240)
    return np.column_stack([r * np.cos(a), r * np.sin(a), z]), n, area


def box(x, y, z, count=100):
    parts = []
    for axis, (half, middle) in enumerate([(x / 2, 0.0), (y / 2, 0.0), (z / 2, z / 2)]):
        others = [i for i in range(3) if i != axis]
        extents = [[(-x / 2, x / 2), (-y / 2, y / 2), (0, z)][i] for i in others]
        u, v = (g.ravel() for g in np.meshgrid(*(middles(*e, count) for e in extents)))
        area = np.prod([e[1] - e[0] for e in extents]) / count**2
        for sign in (-1.0, 1.0):
            position, normal = np.empty((len(u), 3)), np.zeros((len(u), 3))
            position[:, others[0]], position[:, others[1]], position[:, axis] = u, v, middle + sign * half
            normal[:, axis] = sign
            parts.append((position, normal, np.full(len(u), area)))
    return joined(parts)


def joined(parts):
    return tuple(np.concatenate(column) for column in zip(*parts))


R, H = 0.01, 0.04


def sphere():
    polar, a = (g.ravel() for g in np.meshgrid(middles(0, np.pi, 200), middles(0, 2 * np.pi, 240)))
    n = np.column_stack([np.sin(polar) * np.cos(a), np.sin(polar) * np.sin(a), -np.cos(polar)])
    return R * n + [0, 0, R], n, R**2 * np.sin(polar) * (np.pi / 200) * (2 * np.pi / 240)


SURFACES = {
    "sphere": sphere(),
    "cylinder": joined([disk(R, 0.0, -1.0), disk(R, H, 1.0),
                        mantle(lambda z: R + 0 * z, 0, H, lambda z: 0 * z)]),
    "cone": joined([disk(R, H, 1.0), mantle(lambda z: R * z / H, 0, H, lambda z: R / H + 0 * z)]),
    "box": box(0.02, 0.02, H),
    "plate": box(0.004, 0.04, H),
}


def rotation(q):
    x, y, z, w = q
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def theory(shape, depth, q, direction):
    positions, normals, areas = SURFACES[shape]
    r, n = positions @ rotation(q).T, normals @ rotation(q).T
    below = depth - (r[:, 2] - r[:, 2].min())
    leads = (below > 0) & (n @ direction >= 0)
    r = r[leads]
    force = resistance() * (areas * below)[leads][:, None] * stress(n[leads], direction)
    return np.concatenate([force.sum(axis=0), np.cross(r, force).sum(axis=0)])


@pytest.mark.parametrize("cell, count", [(0.002, 1700), (0.001, 850), (0.0005, 400)])
def test_random_ticks_are_those_of_the_theory(cell, count):
    random = np.random.default_rng(43)
    shapes = random.choice(list(SURFACES), count)
    depths = random.uniform(4 * cell, 0.025, count)
    turns, directions = random.normal(size=(count, 4)), random.normal(size=(count, 3))
    turns[shapes == "sphere"] = [0.0, 0.0, 0.0, 1.0]  # its tip is where it is lowest, however it is turned
    turns /= np.linalg.norm(turns, axis=1)[:, None]
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    lines = "\n".join(f"{shape} {depth} {cell} {' '.join(map(str, q))} {' '.join(map(str, u))}"
                      for shape, depth, q, u in zip(shapes, depths, turns, directions))
    told = subprocess.run([os.environ["SANDSTROKE_FELT_TICKS"]], input=lines, capture_output=True, text=True, check=True)
    felt = np.array([[float(word) for word in line.split()] for line in told.stdout.splitlines()])
    exact = np.array([theory(*tick) for tick in zip(shapes, depths, turns, directions)])
    assert felt.shape == exact.shape
    # A hand does not feel 10 mN: a part of that says nothing.
    errors = np.linalg.norm(felt[:, :3] - exact[:, :3], axis=1) / np.maximum(np.linalg.norm(exact[:, :3], axis=1), 0.01)
    print(f"cells of {cell} m: median {np.median(errors):.4f}, 95 % {np.quantile(errors, 0.95):.4f}")
    for shape in SURFACES:
        of = errors[shapes == shape]
        print(f"  {shape}: median {np.median(of):.4f}, 95 % {np.quantile(of, 0.95):.4f}, most {of.max():.3f}")
    arms = np.linalg.norm(felt[:, 3:] - exact[:, 3:], axis=1) / np.maximum(np.linalg.norm(exact[:, 3:], axis=1), 1e-4)
    print(f"  torque: median {np.median(arms):.4f}, 95 % {np.quantile(arms, 0.95):.4f}")
    assert np.median(errors) < 0.01 and np.median(arms) < 0.01
    assert np.quantile(errors, 0.95) < 0.05
