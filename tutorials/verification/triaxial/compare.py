"""Ratio of the largest to the smallest principal stress of all points, and the rate of dilatancy, at failure."""

import sys

import numpy as np

sys.path.insert(0, "..")
import verification as v  # noqa: E402

PHI, PSI = np.radians(38), np.radians(1)
RATIO = (1 + np.sin(PHI)) / (1 - np.sin(PHI))
RATE = -2 * np.sin(PSI) / (1 - np.sin(PSI))


def ratios(points):
    """Largest over smallest compressive principal stress, per point."""
    centre, radius = (points.rr + points.zz) / 2, np.hypot((points.rr - points.zz) / 2, points.rz)
    return np.minimum(centre - radius, points.tt) / np.maximum(centre + radius, points.tt)


runs = v.folders()
figure, axes = v.picture("axial strain [-]", "principal stresses: largest/smallest [-]")
stresses, dilatancies = [], []
for run in runs:
    record = np.loadtxt(run / "postProcessing/platen/0/platen.dat")
    points = v.written(run)
    axial = np.array([-np.log(1 - np.interp(p.time, record[:, 0], record[:, 1])) for p in points])
    volumetric = np.array([-np.log(np.sum(p.volume)) for p in points])
    got = np.array([ratios(p) for p in points])
    half = len(points) // 2  # soil fails long before
    stresses.append(np.max(np.abs(got[half:] / RATIO - 1)))
    dilatancies.append((volumetric[-1] - volumetric[half]) / (axial[-1] - axial[half]) / RATE - 1)
    axes.plot(axial, got.mean(axis=1), "-", linewidth=1, label=f"{v.cells(run)} cells a side")
axes.axhline(RATIO, color="black", linewidth=0.8, linestyle="--", label=f"exact: {RATIO:.4f}")
v.save(figure, axes)
v.report("triaxial: stress ratio at any point", runs, stresses, target=1e-6, last=False)
v.report("triaxial: dilatancy rate", runs, dilatancies, target=1e-3)
