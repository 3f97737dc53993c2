"""First mode of a saturated column against its exact equations of motion: rms of its velocity over two periods, over that at the start."""

import sys

import numpy as np

sys.path.insert(0, "..")
import verification as v  # noqa: E402


E, nu, n, Kw, k, rho_s, rho_w = 60e6, 0.25, 0.35, 20e6, 1e-4, 2650, 1000
M = E * (1 - nu) / ((1 + nu) * (1 - 2 * nu))
mw, ms, K = n * rho_w, (1 - n) * rho_s, np.pi / 2
drag = n**2 * rho_w * 9.81 / k
s = Kw / n * K**2
# displacements and velocities of water and soil: d/dt (uw, us, w, v)
A = np.array([[0, 0, 1, 0], [0, 0, 0, 1],
              [-s * n * n / mw, -s * n * (1 - n) / mw, -drag / mw, drag / mw],
              [-s * n * (1 - n) / ms, -(s * (1 - n) ** 2 + K**2 * M) / ms, drag / ms, -drag / ms]])
values, vectors = np.linalg.eig(A)
weights = np.linalg.solve(vectors, np.array([0, 0, 1, 1], complex))


def exact(time):
    """Velocity of the soil in the mode, over that at the start."""
    return np.real(vectors[3] * weights @ np.exp(np.outer(values, time)))


runs = v.folders()
figure, axes = v.picture("time [ms]", "velocity of the mode/its start [-]")
errors = []
for run in runs:
    written = v.written(run)
    time = np.array([p.time for p in written])
    got = np.array([2 * np.mean(p.vz * np.sin(K * p.Z)) for p in written]) / 1e-3
    errors.append(np.sqrt(np.mean((got - exact(time)) ** 2)))
    axes.plot(1e3 * time, got, ".", markersize=3, label=f"{v.cells(run)} cells")
time = np.linspace(0, written[-1].time, 400)
axes.plot(1e3 * time, exact(time), "k-", linewidth=0.8, label="exact")
v.save(figure, axes)
v.report("column wave: velocity of the first mode", runs, errors, target=3e-2 if v.cells(runs[-1]) < 20 else 5e-3, least_order=1.7)
