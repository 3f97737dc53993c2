"""Flow below sheet piles, and the gradient at which it leaves the soil beside them, against the exact ones."""

import sys

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

sys.path.insert(0, "..")
import verification as v  # noqa: E402

K, HEAD, GAMMA = 1e-11 / 1e-3 * 9810, 10e3 / 9810, 9810  # permeability [m/s], head [m], unit weight of water
DEPTHS = (0.25, 0.5, 0.75)  # of the pile over that of the layer, 1 m


def complete(m):
    """Complete elliptic integral of the first kind, of the modulus m, by the mean of Gauss [Abramowitz & Stegun 17.6]."""
    a, b = 1.0, np.sqrt(1 - m**2)
    while abs(a - b) > 1e-15:
        a, b = (a + b) / 2, np.sqrt(a * b)
    return np.pi / (2 * a)


def exact_flow(depth):
    """q/(k h) [Harr 1962, ch. 5]."""
    return complete(np.cos(np.pi * depth / 2)) / (2 * complete(np.sin(np.pi * depth / 2)))


def exact_exit(depth):
    """Exit gradient beside the pile times s/h, from the same map of the layer onto a half plane (README)."""
    return np.pi * depth / (4 * complete(np.sin(np.pi * depth / 2)) * np.sin(np.pi * depth / 2))


def folder(run, depth):
    """Where the run of a pile is."""
    return run if depth == 0.5 else run / "depths" / str(depth)


def flow(run, depth):
    """q/(k h) through the seabed."""
    record = np.genfromtxt(folder(run, depth) / "postProcessing/seepage/0/seepage.dat", names=True, skip_header=1)
    return float(record["patch_seabed"]) / (K * HEAD)


def exit_gradient(run, depth):
    """Slope of the excess pressure at the seabed beside the pile times s/(gamma_w h): parabola of the first two rows."""
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(next((folder(run, depth) / "VTK/seepage").glob("seepage_*.vtu"))))
    reader.Update()
    x, _, z = vtk_to_numpy(reader.GetOutput().GetPoints().GetData()).T
    excess = vtk_to_numpy(reader.GetOutput().GetPointData().GetArray("excessPressure"))
    beside = np.flatnonzero(np.abs(x) < 1e-9)
    _, first, second = beside[np.argsort(-z[beside])][:3]
    a, b = -z[first], -z[second]
    slope = (excess[first] / a * b - excess[second] / b * a) / (b - a)
    return slope / GAMMA * depth / HEAD


runs = v.folders()
flows = np.array([[flow(run, depth) for depth in DEPTHS] for run in runs])
exits = np.array([[exit_gradient(run, depth) for depth in DEPTHS] for run in runs])
figure, axes = v.picture("depth of the pile/that of the layer [-]", "flow q/(k h), exit gradient i s/h [-]")
depths = np.linspace(0.02, 0.95, 100)
axes.plot(depths, [exact_flow(depth) for depth in depths], "k-", linewidth=0.8, label="flow, exact")
axes.plot(depths, [exact_exit(depth) for depth in depths], "k--", linewidth=0.8, label="exit gradient, exact")
for k, run in enumerate(runs):
    axes.plot(DEPTHS, flows[k], "osv^"[k % 4], color=f"C{k}", markersize=5, fillstyle="none", label=f"{v.cells(run)} cells")
    axes.plot(DEPTHS, exits[k], "osv^"[k % 4], color=f"C{k}", markersize=5, fillstyle="none")
v.save(figure, axes)
for k, depth in enumerate(DEPTHS):
    v.report(f"sheet pile to {depth} of the depth: flow", runs, flows[:, k] / exact_flow(depth) - 1,
             target=2e-2 if v.cells(runs[-1]) < 20 else 5e-3, last=False)
for k, depth in enumerate(DEPTHS):
    v.report(f"sheet pile to {depth} of the depth: exit gradient", runs, exits[:, k] / exact_exit(depth) - 1,
             target={10: 6e-2, 20: 1.5e-2}.get(v.cells(runs[-1]), 5e-3), last=depth == DEPTHS[-1])
