"""Places, stresses and momentum of a block in free fall against those of a mass point."""

import sys

import numpy as np

sys.path.insert(0, "..")
import verification as v  # noqa: E402

E, G = 1e6, 9.81

runs = v.folders()
figure, axes = v.picture("time [s]", "error [-]")
places, stresses, momenta = [], [], []
for run in runs:
    points = v.written(run)[1:]
    time = np.array([p.time for p in points])
    fall = [np.max(np.hypot(p.r - p.R, p.z - p.Z + G * p.time**2 / 2)) / (G * p.time**2 / 2) for p in points]
    stress = [np.max(np.abs([p.rr, p.tt, p.zz, p.rz])) / E for p in points]
    momentum = [np.hypot(np.sum(p.mass * p.vr), np.sum(p.mass * (p.vz + G * p.time))) / np.sum(p.mass * G * p.time)
                for p in points]
    places.append(max(fall))
    stresses.append(max(stress))
    momenta.append(max(momentum))
    line, = axes.semilogy(time, fall, "-", linewidth=1, label=f"{v.cells(run)} cells: place")
    axes.semilogy(time, stress, "--", linewidth=1, color=line.get_color(), label="stress/E")
v.save(figure, axes)
v.report("free fall: place", runs, places, target=1e-12, last=False)
v.report("free fall: stress/E", runs, stresses, target=1e-10, last=False)
v.report("free fall: momentum", runs, momenta, target=1e-12)
