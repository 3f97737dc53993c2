"""Energy of the bar, mean of the tenth period against that of the first, and velocity of its centre of mass."""

import sys

import numpy as np

sys.path.insert(0, "..")
import verification as v  # noqa: E402

E, PERIOD = 100, 10


def energy(points):
    """Kinetic, and elastic: sigma = E ln(stretch) does the work E (e - 1 + exp(-e)), e = sigma/E, per volume now."""
    strain = points.zz / E
    return (0.5 * np.sum(points.mass * (points.vr**2 + points.vz**2))
            + np.sum(points.volume * E * (strain - 1 + np.exp(-strain))))


def velocity(points, V0):
    """Velocity of the centre of mass over that of the first mode at the start."""
    return np.sum(points.mass * points.vz) / np.sum(points.mass) / (2 / np.pi * V0)


runs = v.folders()
figure, axes = v.picture("time/period [-]", "energy/energy of the first period [-]")
SETTINGS = {"": (0.75, runs), "small ": (0.1, [run / "small" / run.name for run in runs])}
drifts, errors = {name: [] for name in SETTINGS}, {name: [] for name in SETTINGS}
for name, (V0, own) in SETTINGS.items():
    for k, run in enumerate(own):
        points = v.written(run)
        time = np.array([p.time for p in points]) / PERIOD
        energies = np.array([energy(p) for p in points])
        first = energies[(time > 0) & (time <= 1)].mean()
        drifts[name].append(energies[time > 9].mean() / first - 1)
        got = np.array([velocity(p, V0) for p in points])[time <= 2]
        exact = np.cos(2 * np.pi * time[time <= 2])
        errors[name].append(np.sqrt(np.sum((got - exact) ** 2) / np.sum(exact**2)))
        axes.plot(time, energies / first, "--" if name else "-", color=f"C{k}", linewidth=0.8,
                  label=f"{v.cells(run)} cells, {V0:g} m/s")
axes.axhline(1, color="black", linewidth=0.8, label="exact")
v.save(figure, axes)
v.report("bar, small: velocity of the centre of mass", SETTINGS["small "][1], errors["small "], target=0.01, last=False)
v.report("bar, small: drift of the energy in ten periods", SETTINGS["small "][1], drifts["small "], target=0.01, last=False)
v.report("bar: velocity of the centre of mass", runs, errors[""], target=0.05, last=False)
v.report("bar: drift of the energy in ten periods", runs, drifts[""], target=0.01)
