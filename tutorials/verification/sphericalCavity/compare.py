"""Pressure in the expanding spherical cavities against the exact one at the radius that they have reached: largest deviation."""

import sys

import numpy as np

sys.path.insert(0, "..")
import cavity  # noqa: E402
import verification as v  # noqa: E402

NAMES = ["sand", "clay"]
runs = v.folders()
figure, axes = v.picture("radius of the cavity/initial radius [-]", "pressure/initial pressure [-]")
growth = np.linspace(1, 2.1, 300)
errors = {}
for name, marker in zip(NAMES, ".x"):
    soil = cavity.SOILS[name]
    errors[name] = []
    for k, run in enumerate(runs):
        written = v.written(run / name / run.name)
        radius = np.array([cavity.wall(run / name / run.name, points, m=2).mean() for points in written])
        pressure = np.interp([points.time for points in written], *cavity.schedule(soil, m=2))
        errors[name].append(cavity.deviation(soil, radius, pressure, m=2))
        label = f"{v.cells(run)} cells, {name}" if name == NAMES[0] or run == runs[-1] else None
        axes.plot(radius, pressure / soil.p0, marker, color=f"C{k}", markersize=4, label=label)
    axes.plot(growth, soil.pressure(growth, m=2) / soil.p0, "k-", linewidth=0.8, label="exact" if name == NAMES[0] else None)
v.save(figure, axes)
for name in NAMES:
    own = [run / name / run.name for run in runs]
    target = 0.04 if name == "clay" and v.cells(runs[-1]) < 20 else 0.01
    v.report(f"spherical cavity in {name}: pressure", own, errors[name], target, last=name == NAMES[-1])
