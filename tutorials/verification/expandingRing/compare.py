"""Displacement of the ring over a period against the manufactured solution."""

import sys

import numpy as np

sys.path.insert(0, "..")
import verification as v  # noqa: E402

E, RHO, A, RI, RO = 1e5, 2000, 0.1, 0.4, 1
C = np.sqrt(E / RHO)  # Poisson's ratio 0
W = np.pi * C / (RO - RI)


def shape(R):
    """U of r = R + f U."""
    return R**3 / 3 - (RI + RO) / 2 * R**2 + RI * RO * R


def exact(points):
    """Displacement along r and z."""
    return A * np.sin(W * points.time) * shape(points.R), 0


runs = v.folders()
figure, axes = v.picture("time [ms]", "displacement of the inner edge [mm]")
errors = []
for run in runs:
    written = v.written(run)
    errors.append(v.displacement_error(written, exact))
    inner = [(p.time, (p.r - p.R)[p.R < p.R.min() + 1e-9].mean() / shape(p.R.min()) * shape(RI)) for p in written]
    axes.plot(*(1e3 * np.array(inner).T), ".", markersize=5, label=f"{v.cells(run)} cells")
time = np.linspace(0, written[-1].time, 200)
axes.plot(1e3 * time, 1e3 * A * np.sin(W * time) * shape(RI), "k-", linewidth=0.8, label="exact")
v.save(figure, axes)
v.report("expanding ring: displacement", runs, errors, target={8: 0.015, 16: 4e-3, 32: 1e-3}.get(v.cells(runs[-1]), 3e-4),
         least_order=1.7)
