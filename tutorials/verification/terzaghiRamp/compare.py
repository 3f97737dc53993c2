"""Pore pressure at the end of the ramp of the load against the exact series: rms over the points, over the load."""

import sys

import numpy as np

sys.path.insert(0, "..")
import verification as v  # noqa: E402


E, n, Kw, k, q, ramp = 1e7, 0.4, 2e8, 1e-3, 1e4, 0.1
cv = k / (9810 * (1 / E + n / Kw))
rate = Kw / n / (E + Kw / n) * q / ramp


def exact(depth):
    """Pore pressure at the end of the ramp [Pa]: Terzaghi's series, integrated over the load that has come."""
    a = (2 * np.arange(200) + 1) * np.pi / 2
    return rate * np.sum(2 / (a**3 * cv) * np.sin(np.outer(depth, a)) * (1 - np.exp(-(a**2) * cv * ramp)), axis=1)


runs = v.folders()
figure, axes = v.picture("pore pressure/load [-]", "height [m]")
errors = []
for run in runs:
    points = v.written(run)[-1]
    errors.append(np.sqrt(np.mean((points.porePressure - exact(1 - points.Z)) ** 2)) / q)
    axes.plot(points.porePressure / q, points.z, ".", markersize=3, label=f"{v.cells(run)} cells: rms {errors[-1]:.1e}")
height = np.linspace(0, 1, 200)
axes.plot(exact(1 - height) / q, height, "k-", linewidth=0.8, label="exact")
v.save(figure, axes)
v.report("terzaghi ramp: pore pressure", runs, errors, target=6e-3 if v.cells(runs[-1]) < 35 else 4e-3)
