"""Reading of caissonFoam's results for the plotting scripts beside this file. SI units throughout."""

import argparse
import os
import re
import subprocess
import sys
from pathlib import Path

import matplotlib
import numpy as np

matplotlib.use("Agg")


class PlotError(Exception):
    """What the user has to change, in words."""


def run(main):
    """Runs main(); a PlotError becomes a message and status 1."""
    try:
        main()
    except PlotError as error:
        sys.exit(f"--> CAISSONFOAM FATAL ERROR : {error}")


def parser(description, picture):
    """Options that all the scripts share; `picture` is the default name of the file they write."""
    result = argparse.ArgumentParser(description=description, add_help=False, allow_abbrev=False)
    result.add_argument("-help", "-h", action="help", help="print this")
    result.add_argument("-case", type=Path, default=Path("."), help="case directory (default: here)")
    result.add_argument("-body", default="caisson", help="name in constant/bodies (default: caisson)")
    result.add_argument("-output", type=Path, help=f"picture to write (default: postProcessing/{picture})")
    result.set_defaults(picture=picture)
    return result


def save(figure, options):
    """Writes the picture where the options say, and says where."""
    file = options.output or options.case / "postProcessing" / options.picture
    file.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(file, dpi=150)
    print(f"Wrote {file}")


def read_table(file):
    """Names of the columns (the last words behind '#') and the rows of a .dat file."""
    names = []
    try:
        with open(file, encoding="utf-8") as lines:
            for line in lines:
                if line.startswith("#"):
                    names = line[1:].split()
        rows = np.loadtxt(file, ndmin=2)
    except OSError as error:
        raise PlotError(f"{file}: {error.strerror}") from None
    except ValueError as error:
        raise PlotError(f"{file}: {error}") from None
    if rows.shape[0] == 0 or len(names) != rows.shape[1]:
        raise PlotError(f"{file}: {rows.shape[1]} columns but {len(names)} names in the header ({' '.join(names)})")
    return names, rows


def column(file, names, rows, *candidates):
    """The first column that has one of the names."""
    for name in candidates:
        if name in names:
            return rows[:, names.index(name)]
    raise PlotError(f"{file}: no column {' or '.join(candidates)}; there are {' '.join(names)}")


class Body:
    """Geometry of a caisson in constant/bodies, and its record in postProcessing/<body>."""

    def __init__(self, case, name):
        self.case, self.name = case, name
        self.outer_radius = self._entry("outerRadius")
        self.inner_radius = self.outer_radius - self._entry("wallThickness")
        self.length = self._entry("skirtLength")
        self.surface = self._entry("surfaceLevel", 0.0)

        files = sorted(case.glob(f"postProcessing/{name}/*/*.dat"), key=lambda file: float(file.parent.name))
        if not files:
            raise PlotError(f"{case}/postProcessing/{name}: no .dat file; run the solver first")
        self.file, self.rows = files[-1], np.empty((0, 0))
        for file in files:  # a restart's record takes over from the time it starts at
            self.names, rows = read_table(file)
            earlier = self.rows[self.rows[:, 0] < rows[0, 0]] if self.rows.size else rows[:0]
            self.rows = np.vstack([earlier, rows])
        self.time = self.rows[:, 0]
        self.penetration = self.column("penetration")

    def column(self, *candidates):
        """Column of the record by name."""
        return column(self.file, self.names, self.rows, *candidates)

    def _entry(self, key, default=None):
        """Number in constant/bodies, as OpenFOAM's foamDictionary expands it."""
        environment = {"WM_PROJECT_DIR": "/usr/share/openfoam"} | dict(os.environ)
        answer = subprocess.run(
            ["foamDictionary", "-entry", f"{self.name}/{key}", "-value", self.case / "constant" / "bodies"],
            env=environment, capture_output=True, text=True, check=False)
        if answer.returncode == 0:
            return float(answer.stdout)
        if default is None:
            raise PlotError(f"{self.case}/constant/bodies: {self.name}.{key} is missing or no number")
        return default


def snapshots(case):
    """(time, file) of every cloud in the case's VTK folder, in the order of time."""
    found = [(float(match[1]), file) for file in case.glob("VTK/**/materialPoints_*.vtp")
             if (match := re.fullmatch(r"materialPoints_(.+)\.vtp", file.name))]
    if not found:
        raise PlotError(f"{case}/VTK: no materialPoints_<time>.vtp; run the solver first")
    return sorted(found)


def read_points(file):
    """Ids (sorted) and positions (r, z) of the material points of a .vtp file."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(file))
    reader.Update()
    data = reader.GetOutput()
    ids = data.GetPointData().GetArray("id")
    if ids is None:
        raise PlotError(f"{file}: no material points with the field id")
    ids = vtk_to_numpy(ids).astype(int)
    x, y, z = vtk_to_numpy(data.GetPoints().GetData()).astype(float).T
    order = np.argsort(ids)
    return ids[order], np.column_stack([np.hypot(x, y), z])[order]


def read_fields(file, *names):
    """Places r and z, and the named fields, of the material points of a .vtp file, as a dictionary."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(file))
    reader.Update()
    data = reader.GetOutput()
    x, y, z = vtk_to_numpy(data.GetPoints().GetData()).astype(float).T
    fields = {"r": np.hypot(x, y), "z": z}
    for name in names:
        array = data.GetPointData().GetArray(name)
        if array is None:
            raise PlotError(f"{file}: the material points have no field {name}")
        fields[name] = vtk_to_numpy(array).astype(float)
    return fields


def common_points(first, second):
    """Positions of the points that both clouds (ids, positions) have, in the same order."""
    _, i, j = np.intersect1d(first[0], second[0], assume_unique=True, return_indices=True)
    return first[1][i], second[1][j]


class Surface:
    """Soil surface of a cloud: the highest points of columns that widen away from a body's wall, as the points do."""

    def __init__(self, body, positions):
        r, z = positions.T
        distance = [0.0]
        while distance[-1] < r.max():
            distance.append(1.12 * distance[-1] + 0.05)
        distance = np.array(distance)
        inside = body.inner_radius - distance[distance < body.inner_radius - 0.1]
        self.parts = []     # radii and levels, inside and outside the body
        for edges in (np.append(0.0, inside[::-1]), body.outer_radius + distance):
            cell = np.searchsorted(edges, r, side="right") - 1
            here = (cell >= 0) & (cell < len(edges) - 1)
            top = np.full(len(edges) - 1, -np.inf)
            np.maximum.at(top, cell[here], z[here])
            self.parts.append((0.5 * (edges[:-1] + edges[1:]), top))

    def level(self, r, wall):
        """Height at radii r; `wall`, the radius of the wall's middle, divides inside and outside."""
        levels = [np.interp(r, middle[np.isfinite(top)], top[np.isfinite(top)]) for middle, top in self.parts]
        return np.where(r < wall, *levels)
