"""Column under the critical gradient: largest effective stress, and heave."""

import sys

import numpy as np

sys.path.insert(0, "..")
import verification as v  # noqa: E402

WEIGHT = 0.65 * 1650 * 9.81  # of the soil under water, per volume and over 1 m
M = 72e6


def heave(z):
    """Displacement from the column under its weight to the one without effective stress."""
    return WEIGHT / M * (z - z**2 / 2)


def rows(run, points, values):
    """Means over the rows of cells, whose stress is in equilibrium."""
    row = np.floor(points.Z * v.cells(run)).astype(int)
    return np.bincount(row, values) / np.bincount(row)


runs = v.folders()
figure, axes = v.picture("vertical effective stress/weight [-]", "height [m]")
stresses, heaves = [], []
for run in runs:
    points = v.written(run)[-1]
    stress = np.abs([rows(run, points, component) for component in (points.zz, points.rr, points.tt)]) / WEIGHT
    stresses.append(stress.max())
    heaves.append(v.weighted_norm(points.mass, points.z - points.Z - heave(points.Z))
                  / v.weighted_norm(points.mass, heave(points.Z)))
    axes.plot(rows(run, points, points.zz) / WEIGHT, rows(run, points, points.Z), ".", markersize=4,
              label=f"{v.cells(run)} cells")
axes.plot([-1, 0], [0, 1], "k--", linewidth=0.8, label="without seepage")
axes.axvline(0, color="black", linewidth=0.8, label="exact")
v.save(figure, axes)
v.report("critical gradient: effective stress", runs, stresses,
         target={10: 5e-3, 20: 1e-3}.get(v.cells(runs[-1]), 5e-4), last=False)
v.report("critical gradient: heave", runs, heaves, target={10: 5e-3, 20: 1e-3}.get(v.cells(runs[-1]), 5e-4))
