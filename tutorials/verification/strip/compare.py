"""Bearing capacity of the smooth and the rough strip footing against the exact one: mean over 2 to 3 % of half the width."""

import sys

import numpy as np

sys.path.insert(0, "..")
import verification as v  # noqa: E402

su, R, NC = 1e3, 1, 2 + np.pi


def capacity(run):
    """Settlement and mean pressure over the base, relative; and the mean of the latter between 2 and 3 % of settlement."""
    record = np.loadtxt(run / "postProcessing/footing/0/footing.dat")
    depth, pressure = record[:, 1] / R, record[:, 4] / (R * su)
    return depth, pressure, pressure[(depth > 0.02) & (depth < 0.03)].mean()


runs = v.folders()
folders = {"smooth": runs, "rough": [run / "rough" / run.name for run in runs]}
figure, axes = v.picture("settlement/half width [-]", "mean pressure/undrained shear strength [-]")
errors = {}
for (name, own), style in zip(folders.items(), ["-", "--"]):
    errors[name] = []
    for k, run in enumerate(own):
        depth, pressure, mean = capacity(run)
        errors[name].append(mean / NC - 1)
        axes.plot(depth, pressure, style, color=f"C{k}", linewidth=1, label=f"{v.cells(run)} cells, {name}: {mean:.3f}")
axes.axhline(NC, color="black", linewidth=0.8, label=f"exact: {NC:.3f}")
v.save(figure, axes)
target = 0.1 if v.cells(runs[-1]) < 16 else 0.04
v.report("rough strip: bearing capacity", folders["rough"], errors["rough"], target, last=False)
v.report("strip: bearing capacity", runs, errors["smooth"], target)
