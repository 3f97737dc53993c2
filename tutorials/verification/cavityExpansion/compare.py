"""Pressure in the expanding cavity against the exact one at the radius that it has reached: largest deviation."""

import sys
from math import factorial

import numpy as np

sys.path.insert(0, "..")
import verification as v  # noqa: E402

E, nu, phi, psi, p0 = 60e6, 0.25, np.radians(38), np.radians(1), 50e3


def expansion(p):
    """a/a0 under the pressure p, cylinder without cohesion [Yu & Houlsby 1991]."""
    alpha = (1 + np.sin(phi)) / (1 - np.sin(phi))
    beta = (1 + np.sin(psi)) / (1 - np.sin(psi))
    gamma = alpha * (beta + 1) / ((alpha - 1) * beta)
    delta = (alpha - 1) * p0 * (1 + nu) / ((1 + alpha) * E)
    ratio = (1 + alpha) * p / (2 * alpha * p0)
    eta = np.exp((beta + 1) * (1 - 2 * nu) * (1 + nu) * p0 / (E * beta))
    xi = 2 * (1 - nu) * delta / ((alpha - 1) * beta) * (
        alpha * beta + 1 - nu * (alpha + beta) / (1 - nu))
    series = sum(xi**n / factorial(n) * (ratio ** (n - gamma) - 1) / (n - gamma) for n in range(30))
    bracket = (1 - delta) ** ((beta + 1) / beta) - gamma / eta * series
    return (ratio**-gamma / bracket) ** (beta / (beta + 1))


PRESSURE = np.linspace(2, 17.4, 3000) * p0  # up to a/a0 = 3
EXPANSION = expansion(PRESSURE)

runs = v.folders()
figure, axes = v.picture("radius of the cavity/initial radius [-]", "pressure/initial pressure [-]")
errors = []
for run in runs:
    radius, pressure = v.cavity_history(run)
    exact = np.interp(radius, EXPANSION, PRESSURE)
    grown = radius > 1.05
    errors.append(np.abs(pressure / exact - 1)[grown].max())
    axes.plot(radius, pressure / p0, ".", markersize=4, label=f"{v.cells(run)} cells per radius")
axes.plot(EXPANSION[EXPANSION < 2.2], PRESSURE[EXPANSION < 2.2] / p0, "k-", linewidth=0.8, label="exact")
v.save(figure, axes)
v.report("cavity expansion: pressure", runs, errors, target={10: 0.03, 20: 0.02}.get(v.cells(runs[-1]), 0.015),
         least_order=0.5)
