"""Sand at rest: largest velocity, and largest differences of stress and of pore pressure from those of the weight."""

import sys

import numpy as np

sys.path.insert(0, "..")
import verification as v  # noqa: E402

K0, g, LEVEL = 0.384, 9.81, 30
WEIGHT = 0.65 * 1650 * g  # of the soil under water, per volume and over 1 m


def velocity(points):
    """The largest of both phases [m/s]."""
    return max(np.hypot(points.vr, points.vz).max(), np.hypot(points.wr, points.wz).max())


def stress_difference(points):
    """The largest of all components, over the vertical effective stress at the base."""
    vertical = -WEIGHT * (1 - points.Z)
    return max(np.abs(got - exact).max() / WEIGHT
               for got, exact in ((points.zz, vertical), (points.rr, K0 * vertical), (points.tt, K0 * vertical),
                                  (points.rz, 0)))


def excess(points):
    """Excess pore pressure."""
    return points.p - 1000 * g * (LEVEL - points.Z)


runs = v.folders()
figure, axes = v.picture("effective stress and excess pore pressure [kPa]", "height [m]")
velocities, stresses, pressures = [], [], []
for run in runs:
    points = v.written(run)[-1]
    velocities.append(velocity(points))
    stresses.append(stress_difference(points))
    pressures.append(np.abs(excess(points)).max() / WEIGHT)
    color = f"C{runs.index(run)}"
    for stress in (points.zz, points.rr):
        axes.plot(1e-3 * stress, points.Z, ".", color=color, markersize=4)
    axes.plot(1e-3 * excess(points), points.Z, ".", color=color, markersize=4, label=f"{v.cells(run)} cells")
for share, line, label in ((1, "-", "vertical stress"), (K0, "--", "horizontal stress"),
                           (0, ":", "excess pore pressure")):
    axes.plot([-1e-3 * share * WEIGHT, 0], [0, 1], f"k{line}", linewidth=0.8, label=label)
v.save(figure, axes)
v.report("sand at rest: largest velocity [m/s]", runs, velocities, target=1e-8, last=False)
v.report("sand at rest: pore pressure", runs, pressures, target=1e-8, last=False)
v.report("sand at rest: stress", runs, stresses, target={10: 4e-4, 20: 2e-4}.get(v.cells(runs[-1]), 1e-4),
         least_order=1)
