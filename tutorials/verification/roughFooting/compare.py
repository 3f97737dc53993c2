"""Bearing capacity of the rough circular footing against the exact one: mean over 2 to 3 % of the radius."""

import sys

import numpy as np

sys.path.insert(0, "..")
import verification as v  # noqa: E402

# force on the base alone: the sides adhere, too
su, R, NC = 1e3, 1, 6.0482

runs = v.folders()
figure, axes = v.picture("settlement/radius [-]", "mean pressure/undrained shear strength [-]")
errors = []
for run in runs:
    record = np.loadtxt(run / "postProcessing/footing/0/footing.dat")
    depth, pressure = record[:, 1] / R, record[:, 4] / (np.pi * R**2 * su)
    failing = (depth > 0.02) & (depth < 0.03)
    errors.append(pressure[failing].mean() / NC - 1)
    axes.plot(depth, pressure, "-", linewidth=1, label=f"{v.cells(run)} cells: {pressure[failing].mean():.3f}")
axes.axhline(NC, color="black", linewidth=0.8, label=f"exact: {NC:.3f}")
v.save(figure, axes)
v.report("rough footing: bearing capacity", runs, errors, target=0.1 if v.cells(runs[-1]) < 16 else 0.04)
