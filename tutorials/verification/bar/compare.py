"""Energy of the bar: mean of the tenth period against that of the first."""

import sys

import numpy as np

sys.path.insert(0, "..")
import verification as v  # noqa: E402

E, PERIOD = 100, 10


def energy(points):
    """Kinetic, and elastic: sigma = E ln(stretch) does the work E (e - 1 + exp(-e)), e = sigma/E, per volume now."""
    strain = points.zz / E
    return (0.5 * np.sum(points.mass * (points.vr**2 + points.vz**2))
            + np.sum(points.volume * E * (strain - 1 + np.exp(-strain))))


runs = v.folders()
figure, axes = v.picture("time/period [-]", "energy/energy of the first period [-]")
errors = []
for run in runs:
    points = v.written(run)
    time = np.array([p.time for p in points]) / PERIOD
    energies = np.array([energy(p) for p in points])
    first = energies[(time > 0) & (time <= 1)].mean()
    errors.append(energies[time > 9].mean() / first - 1)
    axes.plot(time, energies / first, "-", linewidth=0.8, label=f"{v.cells(run)} cells")
axes.axhline(1, color="black", linewidth=0.8, label="exact")
v.save(figure, axes)
v.report("bar: drift of the energy in ten periods", runs, errors, target=0.01)
