"""Displacement and stresses of the thick sphere against Lame's: volume-weighted rms, relative."""

import sys

import numpy as np

sys.path.insert(0, "..")
import verification as v  # noqa: E402

E, nu, a, b, p = 1e6, 0.3, 1, 2, 1
A = p * a**3 / (b**3 - a**3)


def displacement(radius):
    """Along the radius, under the inner pressure p [Lame 1852]."""
    return A / E * ((1 - 2 * nu) * radius + (1 + nu) * b**3 / (2 * radius**2))


def stresses(radius):
    """Along the radius, across it."""
    return A * (1 - b**3 / radius**3), A * (1 + b**3 / (2 * radius**3))


def errors(points):
    """Of the displacement and of the stresses."""
    radius, angle = np.hypot(points.R, points.Z), np.arctan2(points.Z, points.R)
    sine, cosine = np.sin(angle), np.cos(angle)
    along, across = stresses(radius)
    exact = [along * cosine**2 + across * sine**2, along * sine**2 + across * cosine**2, across,
             (along - across) * sine * cosine]
    off = [got - right for got, right in zip((points.rr, points.zz, points.tt, points.rz), exact)]
    return (v.displacement_error([points], lambda _: (displacement(radius) * cosine, displacement(radius) * sine)),
            v.weighted_norm(points.volume, np.sqrt(sum(x**2 for x in off)))
            / v.weighted_norm(points.volume, np.sqrt(sum(x**2 for x in exact))))


runs = v.folders()
figure, axes = v.picture("radius [m]", "stress/pressure [-]")
found = []
for k, run in enumerate(runs):
    points = v.written(run)[-1]
    found.append(errors(points))
    axes.plot(np.hypot(points.R, points.Z), points.tt, ".", color=f"C{k}", markersize=2, label=f"{v.cells(run)} cells: hoop")
radius = np.linspace(a, b, 200)
axes.plot(radius, stresses(radius)[1], "k-", linewidth=0.8, label="exact")
v.save(figure, axes)
of_displacement, of_stress = zip(*found)
finest = v.cells(runs[-1])
v.report("thick sphere: displacement", runs, of_displacement, target={8: 4e-3, 16: 1e-3}.get(finest, 2.5e-4), least_order=1.7,
         last=False)
v.report("thick sphere: stress", runs, of_stress, target={8: 0.08, 16: 0.04}.get(finest, 0.02), least_order=0.8)
