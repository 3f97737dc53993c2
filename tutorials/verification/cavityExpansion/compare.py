"""Pressure in the expanding cavity against the exact one at the radius that it has reached: largest deviation."""

import sys

import numpy as np

sys.path.insert(0, "..")
import cavity  # noqa: E402
import verification as v  # noqa: E402

soil = cavity.SOILS["sand"]
runs = v.folders()
figure, axes = v.picture("radius of the cavity/initial radius [-]", "pressure/initial pressure [-]")
errors = []
for run in runs:
    radius, pressure = cavity.cylinder(run)
    errors.append(cavity.deviation(soil, radius, pressure))
    axes.plot(radius, pressure / soil.p0, ".", markersize=4, label=f"{v.cells(run)} cells per radius")
growth = np.linspace(1, 2.1, 300)
axes.plot(growth, soil.pressure(growth) / soil.p0, "k-", linewidth=0.8, label="exact")
v.save(figure, axes)
v.report("cavity expansion: pressure", runs, errors, target=0.01)
