"""Force on the jacked caisson, means over 0.1 m of penetration, against the finest run and against a closed form."""

import sys

import numpy as np

sys.path.insert(0, "..")
import verification as v  # noqa: E402

DEPTHS = (0.6, 0.7)


def record(run):
    """Penetration and total force at every record."""
    return np.loadtxt(run / "postProcessing/caisson/0/caisson.dat", usecols=(1, 3), unpack=True)


def mean(penetration, force, depth):
    """Mean force over 0.1 m around a depth."""
    return force[np.abs(penetration - depth) < 0.05].mean()


def closed_form(run):
    """Penetration and jacking force after Houlsby & Byrne [2005], from suctionPressure."""
    file = run / "postProcessing/suctionPressure/0/suctionPressure.dat"
    header = [line for line in file.read_text(encoding="utf-8").splitlines() if line.startswith("#")][-1]
    names = header.lstrip("# ").split()
    return np.loadtxt(file, usecols=(names.index("penetration"), names.index("jackingForce")), unpack=True)


runs = v.folders()
forces = np.array([[mean(*record(run), depth) for depth in DEPTHS] for run in runs])
estimate = closed_form(runs[0])
print("\nmean force [kN] at" + "".join(f"{depth:>7} m" for depth in DEPTHS))
for run, values in zip(runs, forces):
    print(f"{v.cells(run):>10} cells" + "".join(f"{value / 1e3:>9.0f}" for value in values))
print("Houlsby & Byrne:" + "".join(f"{np.interp(depth, *estimate) / 1e3:>9.0f}" for depth in DEPTHS))

figure, axes = v.picture("penetration [m]", "force, mean over 0.1 m [kN]")
depths = np.linspace(0.55, 0.70, 40)
for run in runs:
    penetration, force = record(run)
    axes.plot(depths, [mean(penetration, force, depth) / 1e3 for depth in depths], "-", linewidth=1,
              label=f"cells across the wall: {v.cells(run)}")
axes.plot(depths, np.interp(depths, *estimate) / 1e3, "k--", linewidth=0.8, label="Houlsby & Byrne (2005)")
v.save(figure, axes)
if len(runs) > 1:
    differences = forces[:-1] / forces[-1] - 1
    v.report(f"jacked caisson: force over that with {v.cells(runs[-1])} cells", runs[:-1],
             [row[np.argmax(np.abs(row))] for row in differences],
             target=0.1)
