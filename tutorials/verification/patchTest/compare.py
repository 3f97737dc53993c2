"""Stresses of all points against the uniform ones: largest difference of a component, over the axial stress."""

import sys

import numpy as np

sys.path.insert(0, "..")
import verification as v  # noqa: E402

RADIAL, AXIAL = -3e-5, -1e-4


def spread(points):
    """Largest difference of a component at any point from that of the exact state, over the axial stress."""
    differences = [points.rr - RADIAL, points.tt - RADIAL, points.zz - AXIAL, points.rz]
    return np.max(np.abs(differences)) / abs(AXIAL)


runs = v.folders()
figure, axes = v.picture("time [s]", "largest error of a stress/axial stress [-]")
errors = []
for run in runs:
    points = v.written(run)
    spreads = [spread(p) for p in points]
    errors.append(spreads[-1])
    axes.semilogy([p.time for p in points], spreads, "-", linewidth=1, label=f"{v.cells(run)} cells per block")
v.save(figure, axes)
v.report("patch test: stress", runs, errors, target=2e-11)
