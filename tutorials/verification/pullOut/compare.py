"""Vertical displacement around a rod that slips in an elastic annulus against the exact one."""

import sys

import numpy as np

sys.path.insert(0, "..")
import verification as v  # noqa: E402


a, b, height, p, mu, G = 0.5, 1, 8, 1e3, 0.3, 4e6
tau = mu * p

runs = v.folders()
figure, axes = v.picture("radius [m]", "vertical displacement at half height [µm]")
errors = []
for run in runs:
    points = v.written(run)[-1]
    middle = np.abs(points.Z - height / 2) < height / (8 * v.cells(run))
    got, radius = (points.z - points.Z)[middle], points.R[middle]
    exact = tau * a / G * np.log(b / radius)
    weight = points.volume[middle]
    errors.append(v.weighted_norm(weight, got - exact) / v.weighted_norm(weight, exact))
    record = np.loadtxt(run / "postProcessing/rod/0/rod.dat")
    late = record[:, 0] > 0.9 * record[-1, 0]
    # the rollers at the ends hold the last nodes, which stand for half a cell each
    area = 2 * np.pi * a * height * (1 - 1 / (8 * v.cells(run)))
    shear = -record[late, 6].mean() / area / tau
    axes.plot(radius, 1e6 * got, ".", markersize=4, label=f"{v.cells(run)} cells: shear/(mu p) {shear:.4f}")
    if not abs(shear - 1) < 1e-2:
        sys.exit(f"MISSED: {run}: shear over mu p {shear:.4f}, target 1 within 0.01")
radius = np.linspace(a, b, 100)
axes.plot(radius, 1e6 * tau * a / G * np.log(b / radius), "k-", linewidth=0.8, label="exact")
v.save(figure, axes)
v.report("pull-out: displacement", runs, errors, target=1e-2)
