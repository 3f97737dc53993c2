"""Kinetic energy of the disk against the exact modes: rms of KE(t)/KE(0) over two periods."""

import sys

import numpy as np

sys.path.insert(0, "..")
import verification as v  # noqa: E402

E, nu, rho, R, V0 = 1e8, 0.3, 2000, 10, 1e-3
mu = E / (2 * (1 + nu))
M = E * (1 - nu) / ((1 + nu) * (1 - 2 * nu))
c = np.sqrt(M / rho)


def bessel(order, x):
    """J of integer order, by its integral [Bessel 1824]; exact to rounding for the x here."""
    angle = np.linspace(0, np.pi, 2001)
    values = np.cos(order * angle - np.multiply.outer(x, np.sin(angle)))
    return np.trapz(values, angle, axis=-1) / np.pi


def modes(count):
    """Roots of the free rim: M x J0(x) = 2 mu J1(x)."""
    def condition(x):
        return x * bessel(0, x) - 2 * mu / M * bessel(1, x)

    x = np.arange(0.5, np.pi * (count + 1), 0.1)
    low = x[:-1][condition(x[:-1]) * condition(x[1:]) <= 0]
    high = low + 0.1
    for _ in range(50):
        middle = (low + high) / 2
        left = condition(low) * condition(middle) <= 0
        low, high = np.where(left, low, middle), np.where(left, middle, high)
    return (low + high) / 2


MODES = modes(100)
J0, J1 = bessel(0, MODES), bessel(1, MODES)
J2 = 2 * J1 / MODES - J0
SHARE = 4 * (J2 / MODES) ** 2 / ((J1**2 - J0 * J2) / 2)  # of the energy, for v_r = V0 r/R


def exact(time):
    """KE(t)/KE(0)."""
    return (SHARE * np.cos(np.outer(time, MODES * c / R)) ** 2).sum(axis=1)


runs = v.folders()
figure, axes = v.picture("time [ms]", "KE(t)/KE(0)")
errors = []
for run in runs:
    points = v.written(run)
    time = np.array([p.time for p in points])
    energy = np.array([0.5 * np.sum(p.mass * (p.vr**2 + p.vz**2)) for p in points])
    errors.append(np.sqrt(np.mean((energy / energy[0] - exact(time)) ** 2)))
    axes.plot(1e3 * time, energy / energy[0], ".", markersize=4, label=f"{v.cells(run)} cells")
time = np.linspace(0, time[-1], 400)
axes.plot(1e3 * time, exact(time), "k-", linewidth=0.8, label="exact")
v.save(figure, axes)
v.report("disk: kinetic energy", runs, errors, target={20: 5e-3, 40: 1.5e-3}.get(v.cells(runs[-1]), 4e-4),
         least_order=1.7)
