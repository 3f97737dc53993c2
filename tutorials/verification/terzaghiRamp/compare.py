"""Pore pressure of the cylinder at the end of the ramp, against Terzaghi's series and against two phases with inertia:
rms over the points, over the load."""

import sys

import numpy as np

sys.path.insert(0, "..")
import verification as v  # noqa: E402

E, n, Kw, k, q, RAMP, H = 1e7, 0.4, 2e8, 1e-3, 1e4, 0.1, 1
S = Kw / n
cv = k / (1000 * 9.81 * (1 / E + n / Kw))


def terzaghi(z):
    """Pore pressure over the load at the end of the ramp: Terzaghi's series integrated over the load's growth."""
    a = (2 * np.arange(200) + 1) * np.pi / 2
    share = 2 / (a**3 * cv * RAMP / H**2) * (1 - np.exp(-(a**2) * cv * RAMP / H**2))
    return S / (E + S) * np.sum(share * np.sin(np.outer(H - z, a / H)), axis=1)


def with_inertia(z):
    """The same of two phases that have mass: modes u sin(a z), x' = A x + b t with x = (u_w u_s w v)."""
    a = (2 * np.arange(60) + 1) * np.pi / (2 * H)
    phases = np.array([n, 1 - n])
    mass = np.array([n * 1000, (1 - n) * 2650])
    stiffness = S * np.outer(phases, phases) + np.diag([0, E])
    drag = n**2 * 1000 * 9.81 / k * np.array([[1, -1], [-1, 1]])
    A, b = np.zeros((len(a), 4, 4)), np.zeros((len(a), 4))
    A[:, :2, 2:] = np.eye(2)
    A[:, 2:, :2] = -(a**2)[:, None, None] * stiffness / mass[:, None]
    A[:, 2:, 2:] = -drag / mass[:, None]
    b[:, 3] = -2 / H * np.sin(a * H) * q / RAMP / mass[1]  # the load rests on the skeleton: the top is drained
    rate = -np.linalg.solve(A, b[..., None])
    start = np.linalg.solve(A, rate)
    values, vectors = np.linalg.eig(A)
    free = vectors @ (np.exp(values * RAMP)[..., None] * np.linalg.solve(vectors, -start.astype(complex)))
    amplitude = (start + rate * RAMP + free.real)[..., 0]
    return -S / q * (np.cos(np.outer(z, a)) * a) @ (amplitude[:, :2] @ phases)


runs = v.folders()
figure, axes = v.picture("pore pressure/load [-]", "height [m]")
errors = {terzaghi: [], with_inertia: []}
for run in runs:
    points = v.written(run)[-1]
    for exact, found in errors.items():
        found.append(np.sqrt(np.mean((points.p / q - exact(points.Z)) ** 2)))
    axes.plot(points.p / q, points.Z, ".", markersize=4, label=f"{v.cells(run)} cells")
height = np.linspace(0, H, 200)
axes.plot(terzaghi(height), height, "k-", linewidth=0.8, label="Terzaghi")
axes.plot(with_inertia(height), height, "k--", linewidth=0.8, label="with inertia")
v.save(figure, axes)
v.report("Terzaghi ramp: pore pressure", runs, errors[terzaghi],
         target={10: 2e-2, 20: 7e-3}.get(v.cells(runs[-1]), 6e-3), last=False)
v.report("Terzaghi ramp: pore pressure with inertia", runs, errors[with_inertia],
         target={10: 2e-2, 20: 5e-3}.get(v.cells(runs[-1]), 1.2e-3), least_order=1.7)
