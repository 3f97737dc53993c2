"""Pressure in the expanding cavities against the exact one at the radius that they have reached: largest deviation."""

import sys

import numpy as np
from soils import SOILS

sys.path.insert(0, "..")
import verification as v  # noqa: E402


runs = v.folders()
folders = {"cohesive": runs, "dilatant": [run / "dilatant" / run.name for run in runs]}
figure, axes = v.picture("radius of the cavity/initial radius [-]", "pressure/initial pressure [-]")
growth = np.linspace(1.02, 2.1, 100)
errors = {}
for (name, own), marker in zip(folders.items(), ".x"):
    soil = SOILS[name]
    errors[name] = []
    for k, run in enumerate(own):
        radius, pressure = v.cavity_history(run)
        grown = radius > 1.05
        errors[name].append(np.abs(pressure / soil.pressure(radius) - 1)[grown].max())
        axes.plot(radius, pressure / soil.p0, marker, color=f"C{k}", markersize=4, label=f"{v.cells(run)} cells, {name}")
    axes.plot(growth, soil.pressure(growth) / soil.p0, "k-", linewidth=0.8, label="exact" if name == "cohesive" else None)
v.save(figure, axes)
for name, own in folders.items():
    v.report(f"cavity in {name} soil: pressure", own, errors[name], target={10: 0.03, 20: 0.02}.get(v.cells(runs[-1]), 0.015),
             least_order=0.3, last=name == "dilatant")
