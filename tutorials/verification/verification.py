"""What the comparisons with exact solutions share: reading of runs, the table of errors, the picture. SI units."""

import csv
import re
import sys
from pathlib import Path

import matplotlib
import numpy as np

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402  (after the choice of the backend)

reported, missed = [], []  # rows of runs/results.csv; quantities that miss their target


def folders():
    """The runs to compare, from the command line, in ascending resolution: runs/<cells>."""
    found = [Path(name) for name in sys.argv[1:]]
    if not found:
        sys.exit("Usage: compare.py runs/<cells> ...   (Allrun calls it)")
    return sorted(found, key=cells)


def cells(run):
    """Resolution of a run: its folder's name."""
    return int(run.name)


def read_list(file):
    """Numbers of an ASCII list of OpenFOAM: one row per point."""
    lines = iter(file.read_text(encoding="utf-8").splitlines())
    for line in lines:
        if re.fullmatch(r"\d+", line):
            rows = int(line)
            break
    else:
        sys.exit(f"{file}: no list of points; set writeFormat ascii")
    next(lines)
    text = " ".join(next(lines) for _ in range(rows))
    return np.array(re.sub(r"[()]", " ", text).split(), float).reshape(rows, -1)


class Points:
    """Material points of one time directory: r, z, R, Z (initial places), mass, volume, velocity, stress.

    Two-phase soil has the velocity wr, wz and the pressure p of its liquid besides.
    """

    def __init__(self, directory):
        folder = directory / "lagrangian/materialPoints"
        self.time = float(directory.name)
        self.r, self.z = read_list(folder / "positions")[:, [0, 2]].T
        self.R, self.Z = read_list(folder / "initialPosition")[:, [0, 2]].T
        self.vr, self.vz = read_list(folder / "velocity")[:, [0, 2]].T
        self.rr, self.rz, self.tt, self.zz = read_list(folder / "stress")[:, [0, 2, 3, 5]].T
        self.mass = read_list(folder / "mass")[:, 0]
        self.volume = read_list(folder / "volume")[:, 0]
        self.id = read_list(folder / "id")[:, 0]
        if (folder / "porePressure").exists():
            self.wr, self.wz = read_list(folder / "liquidVelocity")[:, [0, 2]].T
            self.p = read_list(folder / "porePressure")[:, 0]


def written(run):
    """Points of all the times that the run wrote, ascending."""
    times = [directory for directory in run.iterdir() if re.fullmatch(r"[0-9.]+(e-?\d+)?", directory.name)]
    return [Points(directory) for directory in sorted(times, key=lambda directory: float(directory.name))]


def processor_time(run):
    """Seconds of the processor that the steps of the solver took, output apart; of other programs all of their time."""
    if not (run / "log.axiMpmFoam").exists():
        log = next(run.glob("log.*Foam")).read_text(encoding="utf-8")
        return float(re.findall(r"ExecutionTime = ([0-9.]+)", log)[-1])
    log = (run / "log.axiMpmFoam").read_text(encoding="utf-8")
    cost, points = re.search(r"^Speed: ([0-9.]+) ns per point and step \(.*?(\d+) points", log, re.MULTILINE).groups()
    steps = re.search(r"^Stopped: .* after (\d+) steps", log, re.MULTILINE)[1]
    return 1e-9 * float(cost) * int(points) * int(steps)


def weighted_norm(weight, values):
    """Root mean square with weights."""
    return np.sqrt(np.sum(weight * values**2) / np.sum(weight))


def displacement_error(written, exact):
    """Root of the squares of the errors over those of the displacements, over all points and times.

    exact  displacement along r and z of the points of a time
    """
    error = norm = 0
    for points in written:
        r, z = exact(points)
        error += np.sum(points.volume * ((points.r - points.R - r) ** 2 + (points.z - points.Z - z) ** 2))
        norm += np.sum(points.volume * (r**2 + z**2))
    return np.sqrt(error / norm)


def report(quantity, runs, errors, target, least_order=None, last=True):
    """Prints the table, adds to runs/results.csv, and ends with status 1 where a target is missed.

    quantity     what the error is of, in words
    errors       one per run
    target       bound of the error of the finest run, the study's finest resolution or the only one asked for
    least_order  bound of the order between the two finest runs; none where the error does not follow a power
    last         no: another quantity follows, whose report ends with the status of both
    """
    orders = [float("nan")]
    for coarse, fine in zip(range(len(runs)), range(1, len(runs))):
        ratio = np.log(cells(runs[fine]) / cells(runs[coarse]))
        # an error that changes its sign, or vanishes, has no order
        decay = errors[coarse] / errors[fine] if errors[fine] else float("nan")
        orders.append(np.log(decay) / ratio if decay > 0 else float("nan"))
    print(f"\n{quantity}\n{'cells':>6} {'error':>10} {'order':>6} {'CPU [s]':>8}")
    for run, error, order in zip(runs, errors, orders):
        seconds = processor_time(run)
        print(f"{cells(run):>6} {error:>10.2e} {order:>6.2f} {seconds:>8.3g}")
        bound = f"{target:g}" if run == runs[-1] else ""
        reported.append([quantity, cells(run), f"{error:.3e}", f"{order:.2f}", f"{seconds:.3g}", bound])
    with open("runs/results.csv", "w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["quantity", "cells", "error", "order", "cpuSeconds", "target"])
        writer.writerows(reported)
    failed = []
    if not abs(errors[-1]) <= target:
        failed.append(f"error {errors[-1]:.2e} of the finest run, target {target:g}")
    if least_order is not None and len(runs) > 1 and not orders[-1] >= least_order:
        failed.append(f"order {orders[-1]:.2f}, target {least_order:g}")
    if failed:
        print("MISSED: " + "; ".join(failed))
        missed.append(quantity)
    else:
        print(f"within the target {target:g}" + (f", order at least {least_order:g}" if least_order else ""))
    if last and missed:
        sys.exit("MISSED: " + "; ".join(missed))


def picture(xlabel, ylabel):
    """A figure and its axes; save() writes it."""
    figure, axes = pyplot.subplots(figsize=(6, 4), layout="constrained")
    axes.set(xlabel=xlabel, ylabel=ylabel)
    return figure, axes


def save(figure, axes):
    """Writes runs/comparison.png."""
    axes.legend()
    axes.grid(alpha=0.3)
    figure.savefig("runs/comparison.png", dpi=150)
    print("Wrote runs/comparison.png")


def bearing_capacity(name, factor, column):
    """Compares the mean pressure below a circular footing (radius 1 m, undrained shear strength 1 kPa) over 2 to 3 % of
    the radius with the exact one; column: of the force in footing.dat."""
    strength = 1e3
    runs = folders()
    figure, axes = picture("settlement/radius [-]", "mean pressure/undrained shear strength [-]")
    errors = []
    for run in runs:
        record = np.loadtxt(run / "postProcessing/footing/0/footing.dat")
        depth, pressure = record[:, 1], record[:, column] / (np.pi * strength)
        failing = (depth > 0.02) & (depth < 0.03)
        errors.append(pressure[failing].mean() / factor - 1)
        axes.plot(depth, pressure, "-", linewidth=1, label=f"{cells(run)} cells: {pressure[failing].mean():.3f}")
    axes.axhline(factor, color="black", linewidth=0.8, label=f"exact: {factor:.3f}")
    save(figure, axes)
    report(f"{name}: bearing capacity", runs, errors, target=0.1 if cells(runs[-1]) < 16 else 0.04)
