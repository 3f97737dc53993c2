"""A falling block against g t^2/2: largest error of the place of a point, over the height of the fall."""

import sys

import numpy as np

sys.path.insert(0, "..")
import verification as v  # noqa: E402


E, g = 1e6, 9.81

runs = v.folders()
figure, axes = v.picture("time [s]", "fall [m]")
errors = []
for run in runs:
    written = v.written(run)
    last = written[-1]
    fall = 0.5 * g * last.time**2
    errors.append(max(np.abs(last.Z - last.z - fall).max(), np.abs(last.r - last.R).max()) / fall)
    stress = np.abs([last.rr, last.zz, last.tt, last.rz]).max() / E
    momentum = np.sum(last.mass * last.vz) / (np.sum(last.mass) * -g * last.time) - 1
    axes.plot([p.time for p in written], [np.mean(p.Z - p.z) for p in written], "o", markersize=4,
              label=f"{v.cells(run)} rows: stress/E {stress:.0e}, momentum {momentum:+.0e}")
    if not (stress < 1e-10 and abs(momentum) < 1e-12):
        sys.exit(f"MISSED: {run}: stress/E {stress:.1e} (1e-10), momentum off by {momentum:.1e} (1e-12)")
time = np.linspace(0, last.time, 100)
axes.plot(time, 0.5 * g * time**2, "k-", linewidth=0.8, label="exact")
v.save(figure, axes)
v.report("free fall: place", runs, errors, target=1e-11)
