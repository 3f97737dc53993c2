"""Wave in the undrained column: speed of its front, and pore pressure behind it."""

import sys

import numpy as np

sys.path.insert(0, "..")
import verification as v  # noqa: E402

E, nu, n, Kw, q, H = 60e6, 0.25, 0.35, 2.2e9, 1e4, 1
M = E * (1 - nu) / ((1 + nu) * (1 - 2 * nu))
c = np.sqrt((M + Kw / n) / (n * 1000 + (1 - n) * 2650))
B = Kw / n / (M + Kw / n)
BEHIND = 0.4  # height above which the pressure is compared when the front is at 0.2


def front(run, points):
    """Height at which the pore pressure, averaged over the rows of cells, is half of that behind the front."""
    row = np.floor(points.Z * v.cells(run)).astype(int)
    pressure = np.bincount(row, points.p) / np.bincount(row) / (B * q)
    height = (np.arange(v.cells(run)) + 0.5) / v.cells(run)
    first = np.flatnonzero(pressure > 0.5)[0]  # from the base
    return np.interp(0.5, pressure[[first - 1, first]], height[[first - 1, first]])


runs = v.folders()
figure, axes = v.picture("pore pressure/load [-]", "height [m]")
speeds, pressures = [], []
for run in runs:
    way = [points for points in v.written(run) if 0.15 < points.time * c / H < 0.85]
    speed = -np.polyfit([points.time for points in way], [front(run, points) for points in way], 1)[0]
    speeds.append(speed / c - 1)
    last = way[-1]
    pressures.append(np.sqrt(np.mean((last.p[last.Z > BEHIND] / (B * q) - 1) ** 2)))
    overshoot = last.p.max() / (B * q) - 1
    print(f"{v.cells(run)} cells: {speed:.1f} m/s, exact {c:.1f}; the pressure overshoots by {overshoot:.0%}")
    axes.plot(last.p / q, last.Z, "-", linewidth=0.8, label=f"{v.cells(run)} cells")
place = H - c * last.time
axes.plot([B, B, 0, 0], [H, place, place, 0], "k-", linewidth=0.8, label="exact")
axes.set_xlim(right=1.7)
v.save(figure, axes)
v.report("wave: speed of the front", runs, speeds, target={100: 1e-2}.get(v.cells(runs[-1]), 5e-3), least_order=0.5,
         last=False)
v.report("wave: pore pressure behind the front", runs, pressures, target=1e-2)
