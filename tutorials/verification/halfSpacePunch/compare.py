"""Force on a smooth punch on an elastic half-space against the exact one, at rest."""

import sys

import numpy as np

sys.path.insert(0, "..")
import verification as v  # noqa: E402

E, NU, A = 100e6, 0.3, 1

runs = v.folders()
figure, axes = v.picture("time [s]", "force (1-ν²)/(2 E a w) [-]")
errors = []
for run in runs:
    record = np.loadtxt(run / "postProcessing/punch/0/punch.dat")
    record = record[record[:, 1] > 1e-4]
    time, depth, force = record[:, 0], record[:, 1], record[:, 3]
    relative = force * (1 - NU**2) / (2 * E * A * depth)
    errors.append(relative[time > 1.8].mean() - 1)
    axes.plot(time, relative, "-", linewidth=1, label=f"{v.cells(run)} cells")
axes.axhline(1, color="black", linewidth=0.8, label="exact")
v.save(figure, axes)
v.report("punch on a half-space: force", runs, errors, target={4: 0.12, 8: 0.06}.get(v.cells(runs[-1]), 0.02),
         least_order=0.8)
