"""Radial displacement of the thick cylinder against Lame's: volume-weighted rms, relative."""

import sys

import numpy as np

sys.path.insert(0, "..")
import verification as v  # noqa: E402

E, nu, a, b, p = 1e6, 0.3, 1, 2, 1


def exact(r):
    """Radial displacement under the inner pressure p, plane strain [Lame 1852]."""
    return (1 + nu) / E * p * a**2 / (b**2 - a**2) * ((1 - 2 * nu) * r + b**2 / r)


runs = v.folders()
figure, axes = v.picture("radius [m]", "radial displacement [µm]")
errors = []
for run in runs:
    points = v.written(run)[-1]
    got = points.r - points.R
    norm = v.weighted_norm(points.volume, exact(points.R))
    errors.append(v.weighted_norm(points.volume, got - exact(points.R)) / norm)
    axes.plot(points.R, 1e6 * got, ".", markersize=4, label=f"{v.cells(run)} cells")
radius = np.linspace(a, b, 200)
axes.plot(radius, 1e6 * exact(radius), "k-", linewidth=0.8, label="exact")
v.save(figure, axes)
v.report("thick cylinder: displacement", runs, errors,
         target={8: 2e-3, 16: 5e-4}.get(v.cells(runs[-1]), 1.2e-4), least_order=1.7)
