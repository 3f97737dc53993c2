"""Flow and tip pressure of a caisson under suction against two finite-volume solutions, at five depths."""

import sys

import numpy as np

sys.path.insert(0, "..")
import verification as v  # noqa: E402

S, K, D, GAMMA = 10e3, 1e-11 / 1e-3 * 9810, 5, 9810  # suction, permeability, diameter, unit weight of water
# L/D: F = Q gamma_w/(s k D), a = tip pressure/s, for a wall of 50 mm; exit gradient i L gamma_w/s at the wall and the axis,
# for a thin wall. Two independent finite-volume codes, domain 20 D, which agree within 0.3 %.
EXPECTED = {
    0.2: (1.673, 0.3215, 0.506, 0.359),
    0.4: (1.130, 0.2441, 0.615, 0.572),
    0.6: (0.8612, 0.1967, 0.690, 0.679),
    0.8: (0.6976, 0.1648, 0.742, 0.739),
    1.0: (0.5869, 0.1418, 0.779, 0.779),
}


def closed_form(ratio):
    """Tip factor a [Houlsby & Byrne 2005, eq. for the pore pressure at the tip of a caisson in uniform sand]."""
    return 0.45 - 0.36 * (1 - np.exp(-ratio / 0.48))


def folder(run, ratio, diameters):
    """Where the run of a depth in a domain is."""
    return run if (ratio, diameters) == (0.2, 20) else run / "others" / f"{ratio * D:.0f}:{diameters * D}"


def results(run, ratio, diameters=20):
    """F, a, and the exit gradients as in EXPECTED."""
    file = folder(run, ratio, diameters) / "postProcessing/seepage/0/seepage.dat"
    record = np.genfromtxt(file, names=True, skip_header=1)
    scale = GAMMA * ratio * D / S
    return np.array([float(record["plugFlow"]) * GAMMA / (S * K * D), -float(record["tipExcessPressure"]) / S,
                     float(record["exitGradientAtWall"]) * scale, float(record["exitGradientAtAxis"]) * scale])


runs = v.folders()
print("\n| cells | L/D | domain | F | error | a | error | i L gamma_w/s at the wall | expected | at the axis | expected |")
print("|---|---|---|---|---|---|---|---|---|---|---|")
for run in runs:
    for ratio, diameters in [*((ratio, 20) for ratio in EXPECTED), (0.2, 8), (0.2, 3)]:
        flow, tip, wall, axis = results(run, ratio, diameters)
        expected = EXPECTED[ratio]
        print(f"| {v.cells(run)} | {ratio} | {diameters} D | {flow:.4f} | {100 * (flow / expected[0] - 1):+.2f} % | {tip:.4f} | "
              f"{tip - expected[1]:+.4f} | {wall:.3f} | {expected[2]} | {axis:.3f} | {expected[3]} |")

figure, axes = v.picture("L/D [-]", "flow F, tip factor a [-]")
ratios = np.array(list(EXPECTED))
values = np.array([[results(run, ratio) for ratio in ratios] for run in runs])
for k, name in enumerate(["F", "a"]):
    axes.plot(ratios, [EXPECTED[ratio][k] for ratio in ratios], "ks", markersize=7, fillstyle="none",
              label="finite volumes" if k == 0 else None)
    for run, found, colour in zip(runs, values, ["C0", "C1", "C2", "C3"]):
        axes.plot(ratios, found[:, k], "o-", color=colour, markersize=3, linewidth=0.8,
                  label=f"{v.cells(run)} cells across the wall" if k == 0 else None)
axes.plot(np.linspace(0.1, 1, 50), closed_form(np.linspace(0.1, 1, 50)), "k--", linewidth=0.8, label="a, Houlsby & Byrne (2005)")
v.save(figure, axes)

expected = np.array([EXPECTED[ratio] for ratio in ratios])
flows = values[:, :, 0] / expected[:, 0] - 1
tips = values[:, :, 1] - expected[:, 1]


def largest(errors):
    """The error of the largest size at each resolution."""
    return [row[np.argmax(np.abs(row))] for row in errors]


v.report("caisson seepage, L/D = 0.2: flow", runs, flows[:, 0], target=0.01, last=False)
v.report("caisson seepage, L/D = 0.2 to 1: flow, largest error", runs, largest(flows), target=0.01, last=False)
v.report("caisson seepage, L/D = 0.2 to 1: tip factor, largest error", runs, largest(tips), target=0.01, last=False)
v.report("caisson seepage in 8 D: flow over that in 20 D", runs,
         [results(run, 0.2, 8)[0] / results(run, 0.2)[0] - 1 for run in runs], target=0.005, last=False)
v.report("caisson seepage in 3 D: flow over that in 20 D", runs,
         [results(run, 0.2, 3)[0] / results(run, 0.2)[0] - 1 for run in runs], target=0.01)
