"""Displacement in the vortex, to its largest turn and back, against the manufactured solution."""

import sys

import numpy as np

sys.path.insert(0, "..")
import verification as v  # noqa: E402

A = 0.1


def turn(S, time):
    """Angle by which points at the radius S have turned [rad]."""
    x = S - 1
    return np.where(np.abs(x) < 0.25, A / 2 * (1 - np.cos(4 * np.pi * time)) * (1 - 32 * x**2 + 256 * x**4), 0)


def exact(points):
    """Displacement along x and z."""
    S = np.hypot(points.R, points.Z)
    angle = np.arctan2(points.Z, points.R) + turn(S, points.time)
    return S * np.cos(angle) - points.R, S * np.sin(angle) - points.Z


runs = v.folders()
figure, axes = v.picture("radius [m]", "turn at 0.25 s [rad]")
errors = []
for run in runs:
    written = v.written(run)
    errors.append(v.displacement_error(written, exact))
    most = min(written, key=lambda points: abs(points.time - 0.25))
    S = np.hypot(most.R, most.Z)
    angle = np.arctan2(most.z, most.r) - np.arctan2(most.Z, most.R)
    ray = (np.abs(np.arctan2(most.Z, most.R) - np.pi / 8) < 0.02) & (S > 0.6) & (S < 1.4)
    axes.plot(S[ray], angle[ray], ".", markersize=4, label=f"{v.cells(run)} cells per metre")
S = np.linspace(0.6, 1.4, 300)
axes.plot(S, turn(S, 0.25), "k-", linewidth=0.8, label="exact")
v.save(figure, axes)
v.report("vortex: displacement", runs, errors, target={16: 0.075, 32: 0.02}.get(v.cells(runs[-1]), 5e-3),
         least_order=1.7)
