"""Uniform stress of a cylinder under a pressure: largest difference of a stress from the exact one, over the pressure."""

import sys

import numpy as np

sys.path.insert(0, "..")
import verification as v  # noqa: E402


E, nu, pressure = 1e6, 0.3, 1
lame, G = E * nu / ((1 + nu) * (1 - 2 * nu)), E / (2 * (1 + nu))
strain = -pressure / (2 * (lame + G))  # radial and hoop
EXACT = {"rr": -pressure, "tt": -pressure, "zz": 2 * lame * strain, "rz": 0}

runs = v.folders()
figure, axes = v.picture("radius [m]", "radial displacement [µm]")
errors = []
for run in runs:
    points = v.written(run)[-1]
    errors.append(max(np.abs(getattr(points, name) - value).max() for name, value in EXACT.items()) / pressure)
    place = np.abs(points.r - points.R - strain * points.R).max() / abs(strain)
    axes.plot(points.R, 1e6 * (points.r - points.R), ".", markersize=3,
              label=f"{v.cells(run)} cells a block: stress {errors[-1]:.0e}, displacement {place:.0e}")
radius = np.array([0, 1])
axes.plot(radius, 1e6 * strain * radius, "k-", linewidth=0.8, label="exact")
v.save(figure, axes)
v.report("patch test: stress", runs, errors, target=1e-6)
