"""Acceleration of a block that slides down a slope against the exact one."""

import sys

import numpy as np

sys.path.insert(0, "..")
import verification as v  # noqa: E402


g, slope, mu = 9.81, np.pi / 6, 0.3
EXACT = g * (np.sin(slope) - mu * np.cos(slope))

runs = v.folders()
figure, axes = v.picture("time [s]", "velocity [m/s]")
errors = []
for run in runs:
    written = v.written(run)
    time = np.array([p.time for p in written])
    velocity = np.array([np.sum(p.mass * p.vr) / np.sum(p.mass) for p in written])
    late = time > 0.4  # the load comes suddenly: the block swings at first
    got = np.polyfit(time[late], velocity[late], 1)[0]
    errors.append(abs(got / EXACT - 1))
    axes.plot(time, velocity, "o", markersize=4, label=f"{v.cells(run)} cells high: {got:.4f} m/s2")
axes.plot(time, EXACT * time, "k-", linewidth=0.8, label=f"exact: {EXACT:.4f} m/s2")
v.save(figure, axes)
v.report("incline: acceleration", runs, errors, target=5e-3)
