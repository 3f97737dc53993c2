"""A column of sand under 29 m of water stays at rest: its largest velocity after at least 10,000 steps."""

import sys

import numpy as np

sys.path.insert(0, "..")
import verification as v  # noqa: E402


n, rho_s, rho_w, g, level = 0.35, 2650, 1000, 9.81, 30
weight = (1 - n) * (rho_s - rho_w) * g

runs = v.folders()
figure, axes = v.picture("stress and excess pressure [kPa]", "height [m]")
errors = []
for run in runs:
    points = v.written(run)[-1]
    errors.append(max(np.abs([points.vr, points.vz]).max(), 0))
    difference = np.abs(points.zz + weight * (1 - points.Z)).max()
    pressure = np.abs(points.porePressure - rho_w * g * (level - points.z)).max()
    axes.plot(1e-3 * points.zz, points.z, ".", markersize=4,
              label=f"{v.cells(run)} rows: stress within {difference:.0e} Pa, pressure {pressure:.0e} Pa")
height = np.array([0, 1])
axes.plot(-1e-3 * weight * (1 - height), height, "k-", linewidth=0.8, label="vertical effective stress, exact")
v.save(figure, axes)
v.report("self-weight column: largest velocity [m/s]", runs, errors, target=1e-8)
