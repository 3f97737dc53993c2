"""Displacement at half height while the rod sticks and when it slips, and the shear stress on the slipping rod."""

import sys

import numpy as np

sys.path.insert(0, "..")
import verification as v  # noqa: E402

a, b, HEIGHT, p, mu, G = 0.5, 1, 8, 1e3, 0.3, 4e6
STICK, SLIP = 1.6, 3.4  # times: 0.6 and 2.1 times the displacement at which slip starts


def exact(r, rise):
    """Displacement of an annulus, fixed at b, that a rod at a has been pulled through by `rise`."""
    tau = min(mu * p, G * rise / (a * np.log(b / a)))
    return tau * a / G * np.log(b / r)


runs = v.folders()
figure, axes = v.picture("radius [m]", "displacement at half height [µm]")
radius = np.linspace(a, b, 100)
errors = {STICK: [], SLIP: []}
shears = []
for run in runs:
    record = np.loadtxt(run / "postProcessing/rod/0/rod.dat")
    time, rise, force = record[:, 0], -record[:, 1], -record[:, 6]
    # The rollers at the ends hold the last nodes, which stand for half a cell each.
    area = 2 * np.pi * a * HEIGHT * (1 - 1 / (8 * v.cells(run)))
    shears.append(force[time > 0.9 * SLIP].mean() / (mu * p * area) - 1)
    for points in v.written(run):
        if points.time not in errors:
            continue
        row = np.abs(points.Z - HEIGHT / 2) < HEIGHT / (8 * v.cells(run))
        got = (points.z - points.Z)[row]
        right = exact(points.R[row], np.interp(points.time, time, rise))
        weights = points.volume[row]
        errors[points.time].append(v.weighted_norm(weights, got - right) / v.weighted_norm(weights, right))
        axes.plot(points.R[row], 1e6 * got, ".", markersize=4, color=f"C{runs.index(run)}",
                  label=f"{v.cells(run)} cells" if points.time == SLIP else None)
axes.plot(radius, 1e6 * exact(radius, np.interp(SLIP, time, rise)), "k-", linewidth=0.8, label="exact: slips")
axes.plot(radius, 1e6 * exact(radius, np.interp(STICK, time, rise)), "k--", linewidth=0.8, label="exact: sticks")
v.save(figure, axes)
v.report("pull-out: displacement while it sticks", runs, errors[STICK],
         target={4: 1e-2, 8: 3e-3}.get(v.cells(runs[-1]), 1e-3), least_order=1.7, last=False)
v.report("pull-out: displacement while it slips", runs, errors[SLIP], target=1e-2, last=False)
v.report("pull-out: shear stress at slip", runs, shears, target=1e-2)
