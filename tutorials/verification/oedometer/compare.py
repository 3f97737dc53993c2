"""Stresses and heave of sand in an oedometer after unloading, against elasticity."""

import sys

import numpy as np

sys.path.insert(0, "..")
import verification as v  # noqa: E402

E, NU, K0, LOAD, LEFT = 60e6, 0.25, 0.384, 100e3, 50e3
M = E * (1 - NU) / ((1 + NU) * (1 - 2 * NU))
WEIGHT = 0.65 * 2650 * 9.81  # dry [N/m3]


def load(time):
    """Pressure on the top [Pa]."""
    return LOAD + (LEFT - LOAD) * min(time, 1)


runs = v.folders()
figure, axes = v.picture("vertical stress [kPa]", "horizontal stress [kPa]")
vertical, horizontal, heaves = [], [], []
for run in runs:
    written = v.written(run)
    last = written[-1]
    removed = LOAD - LEFT
    start = -(LOAD + WEIGHT * (1 - last.Z))
    vertical.append(np.abs(last.zz - (start + removed)).max() / removed)
    exact = K0 * start + NU / (1 - NU) * removed
    horizontal.append(max(np.abs(last.rr - exact).max(), np.abs(last.tt - exact).max()) / removed)
    heave = removed / M * last.Z
    heaves.append(v.weighted_norm(last.mass, last.z - last.Z - heave) / v.weighted_norm(last.mass, heave))
    middle = np.argmin(np.hypot(written[0].R - 0.5, written[0].Z - 0.5))
    number = written[0].id[middle]
    path = np.array([(p.zz[p.id == number][0], p.rr[p.id == number][0]) for p in written]) / 1e3
    axes.plot(*path.T, ".", markersize=5, label=f"{v.cells(run)} cells")
start = -(LOAD + WEIGHT * (1 - written[0].Z[middle]))
ends = np.array([0, LOAD - LEFT])
axes.plot((start + ends) / 1e3, (K0 * start + NU / (1 - NU) * ends) / 1e3, "k-", linewidth=0.8, label="exact, half height")
v.save(figure, axes)
v.report("oedometer: vertical stress", runs, vertical, target=1e-3, last=False)
v.report("oedometer: horizontal stress", runs, horizontal, target=1e-3, last=False)
v.report("oedometer: heave", runs, heaves, target=1e-3)
