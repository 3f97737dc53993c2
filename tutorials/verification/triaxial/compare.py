"""Triaxial compression of sand at failure: ratio of stresses and rate of dilatation against the exact ones."""

import sys

import numpy as np

sys.path.insert(0, "..")
import verification as v  # noqa: E402


sine, dilation = np.sin(np.radians(38)), np.sin(np.radians(1))
RATIO, RATE = (1 + sine) / (1 - sine), -2 * dilation / (1 - dilation)

runs = v.folders()
figure, axes = v.picture("axial strain [%]", "axial force/(area cell pressure) [-]")
errors = []
for run in runs:
    written = [points for points in v.written(run) if points.time > 0.2]
    last = written[-1]
    errors.append(np.abs(last.zz / last.rr / RATIO - 1).max())
    record = np.loadtxt(run / "postProcessing/platen/0/platen.dat")
    height = -np.interp([points.time for points in written], record[:, 0], record[:, 1])
    rate = np.polyfit(np.log(height), np.log([points.volume.sum() for points in written]), 1)[0]
    axes.plot(-100 * np.log(-record[:, 1]), record[:, 3] / (np.pi * 1e5), "-", linewidth=1,
              label=f"{v.cells(run)} cells: sigma1/sigma3 {np.mean(last.zz / last.rr):.6f}, rate {rate:.5f}")
    if not abs(rate / RATE - 1) < 2e-2:
        sys.exit(f"MISSED: {run}: rate of dilatation {rate:.5f}, exact {RATE:.5f}, target 2 %")
v.save(figure, axes)
v.report("triaxial: stress ratio", runs, errors, target=1e-6)
