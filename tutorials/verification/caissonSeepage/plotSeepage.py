#!/usr/bin/python3
"""Draws the excess pore pressure round the caisson, and the discharge, of the run in this folder."""

import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.tri import Triangulation
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

files = sorted(Path("VTK/seepage").glob("seepage_*.vtu"))
if not files:
    sys.exit("--> CAISSONFOAM FATAL ERROR : VTK/seepage holds no .vtu; run seepageFoam first")
reader = vtkXMLUnstructuredGridReader()
reader.SetFileName(str(files[-1]))
reader.Update()
grid = reader.GetOutput()
r, _, z = vtk_to_numpy(grid.GetPoints().GetData()).T
corners = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(grid.GetNumberOfCells(), -1)
excess = vtk_to_numpy(grid.GetPointData().GetArray("excessPressure"))
discharge = vtk_to_numpy(grid.GetCellData().GetArray("discharge"))
halves = [corners[:, [0, 1, 2]], corners[:, [0, 2, 3]]] if corners.shape[1] == 4 else [corners]
mesh = Triangulation(r, z, np.vstack(halves))
figure, axes = plt.subplots(figsize=(7, 5), layout="constrained")
contours = axes.tricontourf(mesh, excess / 1e4, levels=np.linspace(-1, 0, 21), cmap="turbo")
centre = np.column_stack([r[corners].mean(axis=1), z[corners].mean(axis=1)])
_, some = np.unique(np.round(centre / 0.25), axis=0, return_index=True)
some = some[(centre[some, 0] < 6) & (centre[some, 1] > -4)]
direction = discharge[some][:, [0, 2]]
axes.quiver(*centre[some].T, *(direction / np.linalg.norm(direction, axis=1, keepdims=True)).T, angles="xy", scale=45,
            width=0.002)
axes.fill_between([2.45, 2.5], -1, 0.3, color="black")
axes.set_xlim(0, 6)
axes.set_ylim(-4, 0.3)
axes.set_aspect("equal")
axes.set_xlabel("r [m]")
axes.set_ylabel("z [m]")
figure.colorbar(contours, label="excess pore pressure / suction [-]; arrows: direction of the flow")
Path("postProcessing").mkdir(exist_ok=True)
figure.savefig("postProcessing/seepage.png", dpi=150)
print("Wrote postProcessing/seepage.png")
