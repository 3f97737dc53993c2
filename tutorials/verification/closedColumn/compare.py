"""Water stored in a closed column against the water pressed into it, and its pressure against the exact one."""

import sys

import numpy as np

sys.path.insert(0, "..")
import verification as v  # noqa: E402

M, BULK, POROSITY, GRAINS, WATER = 72e6, 20e6, 0.35, 2650, 1000
MOBILITY, FLUX = 1e-11 / 1e-3, 1e-6  # permeability/viscosity [m2/(Pa s)]; water that enters [m/s]
STORAGE = 1 / M + POROSITY / BULK
SCALE = FLUX / MOBILITY  # of pressures, H = 1 m


def exact(z, time):
    """Pressure of a slab that is fed through one face and closed at the other [Carslaw & Jaeger 1959, art. 3.8]."""
    k = np.arange(1, 60)
    relative = MOBILITY / STORAGE * time
    series = (-1.0) ** k / k**2 * np.exp(-(k**2) * np.pi**2 * relative) * np.cos(np.outer(1 - z, k * np.pi))
    return SCALE * (relative + (3 * (1 - z) ** 2 - 1) / 6 - 2 / np.pi**2 * series.sum(axis=1))


def stored(points):
    """Volume of water at its density of the start: the pores are what the grains, which keep their volume, leave."""
    grains = points.mass / (POROSITY * WATER + (1 - POROSITY) * GRAINS) * (1 - POROSITY)
    return np.sum((points.volume - grains) * (1 + points.p / BULK))


def balance(written, width):
    """Largest error of the water stored since the start, over all that has entered at the end."""
    start, inflow = stored(written[0]), FLUX * width * written[-1].time
    return max(abs(stored(points) - start - FLUX * width * points.time) for points in written[1:]) / inflow


runs = v.folders()
figure, axes = v.picture("pore pressure/(flux H viscosity/permeability) [-]", "height [m]")
errors = {"explicit": [], "projection": []}
balances = {"explicit": [], "projection": []}
for run in runs:
    for coupling, folder in [("explicit", run), ("projection", run / "projection" / run.name)]:
        written = v.written(folder)
        balances[coupling].append(balance(written, 1 / v.cells(run)))
        last = written[-1]
        errors[coupling].append(v.weighted_norm(last.mass, last.p - exact(last.Z, last.time)) / SCALE)
        axes.plot(last.p / SCALE, last.Z, "." if coupling == "explicit" else "x", markersize=4,
                  label=f"{v.cells(run)} cells, {coupling}")
height = np.linspace(0, 1, 100)
axes.plot(exact(height, 1) / SCALE, height, "k-", linewidth=0.8, label="exact")
v.save(figure, axes)
folders = {"explicit": runs, "projection": [run / "projection" / run.name for run in runs]}
for coupling, own in folders.items():
    v.report(f"closed column, {coupling}: water stored over water that entered - 1", own, balances[coupling],
             target=1e-6, last=False)
for coupling, own in folders.items():
    v.report(f"closed column, {coupling}: pore pressure", own, errors[coupling],
             target={10: 5e-3, 20: 1.7e-3}.get(v.cells(runs[-1]), 6e-4), least_order=1.5, last=coupling == "projection")
