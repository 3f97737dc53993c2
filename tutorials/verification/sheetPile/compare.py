"""Flow below a sheet pile against the exact one."""

import sys

import numpy as np

sys.path.insert(0, "..")
import verification as v  # noqa: E402


k, head = 1e-11 / 1e-3 * 9810, 10e3 / 9810
EXACT = 0.5  # q/(k h) for a pile to half the depth of the layer

runs = v.folders()
figure, axes = v.picture("cells along the pile", "flow q/(k h) [-]")
errors, flows = [], []
for run in runs:
    record = np.genfromtxt(run / "postProcessing/seepage/0/seepage.dat", names=True, skip_header=1)
    flows.append(float(record["patch_seabed"]) / (k * head))
    errors.append(abs(flows[-1] / EXACT - 1))
axes.plot([v.cells(run) for run in runs], flows, "o-", markersize=4, label="computed")
axes.axhline(EXACT, color="black", linewidth=0.8, label="exact")
v.save(figure, axes)
v.report("sheet pile: flow", runs, errors, target=2e-2 if v.cells(runs[-1]) < 20 else 5e-3)
