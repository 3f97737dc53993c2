"""Bearing capacity of the smooth strip footing against the exact one: mean over 2 to 3 % of half the width."""

import sys

import numpy as np

sys.path.insert(0, "..")
import verification as v  # noqa: E402

su, R, NC = 1e3, 1, 2 + np.pi

runs = v.folders()
figure, axes = v.picture("settlement/half width [-]", "mean pressure/undrained shear strength [-]")
errors = []
for run in runs:
    record = np.loadtxt(run / "postProcessing/footing/0/footing.dat")
    depth, pressure = record[:, 1] / R, record[:, 3] / (R * su)
    failing = (depth > 0.02) & (depth < 0.03)
    errors.append(pressure[failing].mean() / NC - 1)
    axes.plot(depth, pressure, "-", linewidth=1, label=f"{v.cells(run)} cells: {pressure[failing].mean():.3f}")
axes.axhline(NC, color="black", linewidth=0.8, label=f"exact: {NC:.3f}")
v.save(figure, axes)
v.report("strip: bearing capacity", runs, errors, target=0.1 if v.cells(runs[-1]) < 16 else 0.04)
