"""Pore pressure of a consolidating column against the series of Terzaghi: rms over the points, over the load."""

import sys

import numpy as np

sys.path.insert(0, "..")
import verification as v  # noqa: E402


E, nu, n, Kw, k, q = 60e6, 0.25, 0.35, 2.2e9, 1e-4, 1e4
M = E * (1 - nu) / ((1 + nu) * (1 - 2 * nu))
cv = k / (9810 * (1 / M + n / Kw))
share = Kw / n / (M + Kw / n)


def exact(depth, time):
    """Excess pore pressure over the load; drained top, closed base, depth over the height."""
    a = (2 * np.arange(200) + 1) * np.pi / 2
    return share * np.sum(2 / a * np.sin(np.outer(depth, a)) * np.exp(-(a**2) * cv * time), axis=1)


runs = v.folders()
figure, axes = v.picture("pore pressure/load [-]", "height [m]")
errors = []
for run in runs:
    for points in v.written(run):
        factor = cv * points.time
        if abs(factor - 0.1) < 1e-3 or abs(factor - 0.5) < 1e-3:
            difference = points.p / q - exact(1 - points.Z, points.time)
            if abs(factor - 0.1) < 1e-3:
                errors.append(np.sqrt(np.mean(difference**2)))
            axes.plot(points.p / q, points.z, ".", markersize=3,
                      label=f"{v.cells(run)} cells, T = {factor:.1f}: rms {np.sqrt(np.mean(difference**2)):.1e}")
height = np.linspace(0, 1, 200)
for factor in (0.1, 0.5):
    axes.plot(exact(1 - height, factor / cv), height, "k-", linewidth=0.8)
v.save(figure, axes)
v.report("terzaghi: pore pressure at T = 0.1", runs, errors, 
         target={12: 5e-3, 25: 1.5e-3}.get(v.cells(runs[-1]), 4e-4), least_order=1.5)
