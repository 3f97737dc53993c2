"""Mean settlement of the column against that of the exact bar: rms over two periods, over the largest."""

import sys

import numpy as np

sys.path.insert(0, "..")
import verification as v  # noqa: E402

E, nu, rho, g, L = 1e8, 0.3, 2000, 0.0981, 10
M = E * (1 - nu) / ((1 + nu) * (1 - 2 * nu))
c = np.sqrt(M / rho)


def exact(time):
    """Mean displacement of a bar, fixed at its foot, that gravity acts on from t = 0: sum of its modes."""
    wave = (2 * np.arange(200) + 1) * np.pi / (2 * L)
    swing = 2 * rho * g / (M * wave**4 * L**2) * np.cos(np.outer(time, wave * c))
    return -rho * g * L**2 / (3 * M) + swing.sum(axis=1)


def settlement(run):
    """Times and mean displacements, weighted with mass."""
    points = v.written(run)
    return (np.array([p.time for p in points]),
            np.array([np.sum(p.mass * (p.z - p.Z)) / np.sum(p.mass) for p in points]))


runs = v.folders()
largest = 2 * rho * g * L**2 / (3 * M)
figure, axes = v.picture("time [ms]", "mean settlement [µm]")
errors = []
for run in runs:
    time, got = settlement(run)
    errors.append(np.sqrt(np.mean((got - exact(time)) ** 2)) / largest)
    axes.plot(1e3 * time, 1e6 * got, ".", markersize=4, label=f"{v.cells(run)} cells")
time = np.linspace(0, 8 * L / c, 400)
axes.plot(1e3 * time, 1e6 * exact(time), "k-", linewidth=0.8, label="exact")
v.save(figure, axes)
v.report("column: mean settlement", runs, errors, target={20: 5e-3, 40: 1.2e-3}.get(v.cells(runs[-1]), 3e-4),
         least_order=1.7)
