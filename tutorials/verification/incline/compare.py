"""Acceleration of the block that slides, by least squares over the second after it is let go; drift of the other."""

import sys

import numpy as np

sys.path.insert(0, "..")
import verification as v  # noqa: E402

RELEASE, SLOPE, FRICTION, G = 0.5, np.radians(30), 0.3, 9.81
ACCELERATION = G * (np.sin(SLOPE) - FRICTION * np.cos(SLOPE))


def means(points, block, values):
    """Mass-weighted means over a block, one per written time."""
    weights = points[0].mass * block
    return np.array([np.average(values(p), weights=weights) for p in points])


runs = v.folders()
figure, axes = v.picture("time since release [s]", "speed downhill, less the exact one [mm/s]")
errors, drifts = [], []
for run in runs:
    points = [p for p in v.written(run) if p.time >= RELEASE]
    time = np.array([p.time for p in points]) - RELEASE
    slides = points[0].R < 5
    speed = means(points, slides, lambda p: p.vr)
    errors.append(np.polyfit(time, speed, 1)[0] / ACCELERATION - 1)
    place = means(points, ~slides, lambda p: p.r)
    drifts.append(np.max(np.abs(place - place[0])))
    axes.plot(time, 1e3 * (speed - ACCELERATION * time), "-", linewidth=1,
              label=f"{v.cells(run)} cells across: {speed[-1]:.3f} m/s at the end")
v.save(figure, axes)
v.report("incline: acceleration of the block that slides", runs, errors, target=5e-3, last=False)
v.report("incline: drift of the block that sticks [m]", runs, drifts, target=1e-9)
