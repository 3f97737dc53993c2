#!/usr/bin/python3
"""Suction and its limits, and the forces, against penetration: reads what suctionPressure wrote."""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

FOLDER = "postProcessing/suctionPressure/0/"


def read(name):
    """Columns of a .dat file by the names in the last line of its header."""
    with open(FOLDER + name + ".dat", encoding="utf-8") as file:
        header = [line for line in file if line.startswith("#")][-1]
    values = np.loadtxt(FOLDER + name + ".dat")
    return dict(zip(header[1:].split(), values.T))


sand = read("suctionPressure")
jacking = read("jacking")

figure, (left, right) = plt.subplots(1, 2, figsize=(11, 6), sharey=True, constrained_layout=True)
z = sand["z/L"]
widest = 1.35 * max(sand["exitGradient"]) / 1e3  # kPa
left.plot(sand["suction"] / 1e3, z, "k", linewidth=2.5, label="suction needed")
for column, label, style in (
    ("liquefaction", "plug liquefies (no effective stress)", "C3-"),
    ("exitGradient", "critical exit gradient", "C1--"),
    ("reverseBearing", "reverse bearing", "C4:"),
    ("cavitation", "cavitation", "C0-."),
):
    beyond = f" (from {min(sand[column]) / 1e3:.0f} kPa, not shown)" if min(sand[column]) / 1e3 > widest else ""
    left.plot(sand[column] / 1e3, z, style, label=label + beyond)
left.set_xlim(0, widest)
left.set_xlabel("suction [kPa]")
left.set_ylabel("penetration z/L [-]")
left.legend(loc="upper right")

right.plot(jacking["jackingForce"] / 1e6, jacking["z/L"], "k", linewidth=2.5, label="jacked: total")
right.plot((sand["outside"] + sand["inside"] + sand["tip"]) / 1e6, z, "C2", linewidth=2.5,
           label="under suction: total")
right.plot(sand["tip"] / 1e6, z, "C2--", label="under suction: tip")
right.plot(sand["outside"] / 1e6, z, "C2:", label="under suction: friction outside")
right.plot(sand["inside"] / 1e6, z, "C2-.", label="under suction: friction inside")
right.set_xlim(left=0)
right.set_xlabel("resistance [MN]")
right.legend(loc="upper right")

for axes in (left, right):
    axes.set_ylim(1, 0)
    axes.grid(alpha=0.3)
figure.suptitle("Suction caisson in dense sand [Houlsby & Byrne 2005]")
figure.savefig("postProcessing/suction.png", dpi=120)
