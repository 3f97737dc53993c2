#!/usr/bin/python3
"""Tests of what the plotting scripts compute, on clouds and records with known answers."""

import sys
import tempfile
import unittest
from importlib.machinery import SourceFileLoader
from importlib.util import module_from_spec, spec_from_loader
from pathlib import Path

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

SCRIPTS = Path(__file__).resolve().parents[2] / "applications" / "utilities" / "postProcessing"
sys.dont_write_bytecode = True
sys.path.insert(0, str(SCRIPTS))

import caissonPlot  # noqa: E402


def script(name):
    """A script as a module."""
    loader = SourceFileLoader(name, str(SCRIPTS / name))
    module = module_from_spec(spec_from_loader(name, loader))
    loader.exec_module(module)
    return module


class SyntheticCase(unittest.TestCase):
    """A caisson of 5 m diameter that goes down at 0.1 m/s from 0.5 m; written every 0.7 s."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.case = Path(folder.name)
        (self.case / "constant").mkdir()
        (self.case / "constant" / "bodies").write_text(
            "half 2.5; caisson { outerRadius $half; wallThickness #eval{0.1*$half - 0.2}; skirtLength 5; }\n")
        self.write_record("0", np.linspace(0, 10, 101))

    def write_record(self, start, time, penetration=None, force=1e5):
        """postProcessing/caisson/<start>/caisson.dat"""
        file = self.case / "postProcessing" / "caisson" / start / "caisson.dat"
        file.parent.mkdir(parents=True)
        penetration = 0.5 + 0.1 * time if penetration is None else penetration
        rows = np.column_stack([time, penetration, np.full_like(time, force)])
        np.savetxt(file, rows, header="Time [s], penetration [m], totalForce [N]\nTime penetration totalForce")

    def write_clouds(self, positions, motion, times):
        """Points whose displacement is motion(positions) times the penetration since the start, in any order."""
        folder = self.case / "VTK" / "materialPoints"
        folder.mkdir(parents=True)
        random = np.random.default_rng(1)
        for time in times:
            order = random.permutation(len(positions))
            r, z = (positions + motion(positions) * 0.1 * time)[order].T
            angle = 0.02
            points = vtkPoints()
            points.SetData(numpy_to_vtk(np.column_stack([r * np.cos(angle), r * np.sin(angle), z]), deep=True))
            cloud = vtkPolyData()
            cloud.SetPoints(points)
            ids = numpy_to_vtk(order.astype(np.int32), deep=True)
            ids.SetName("id")
            cloud.GetPointData().AddArray(ids)
            writer = vtkXMLPolyDataWriter()
            writer.SetFileName(str(folder / f"materialPoints_{time:g}.vtp"))
            writer.SetInputData(cloud)
            writer.Write()

    def body(self):
        return caissonPlot.Body(self.case, "caisson")

    def test_geometry_is_that_of_the_expanded_dictionary(self):
        body = self.body()
        self.assertAlmostEqual(body.outer_radius, 2.5, delta=1e-12)
        self.assertAlmostEqual(body.inner_radius, 2.45, delta=1e-12)
        self.assertEqual(body.surface, 0.0)     # default

    def test_record_of_a_restart_takes_over_from_its_start(self):
        self.write_record("6", np.linspace(6, 12, 61), force=2e5)
        body = self.body()
        self.assertTrue(np.all(np.diff(body.time) > 0), body.time)
        np.testing.assert_allclose(np.interp([5.9, 6, 12], body.time, body.column("totalForce")), [1e5, 2e5, 2e5])

    def test_displacement_is_that_of_the_same_point_between_the_two_depths(self):
        positions = np.random.default_rng(2).uniform([0, -3], [2.4, 0], (500, 2))

        def motion(x):
            return np.column_stack([0.3 * np.exp(x[:, 1]), 0.4 * np.exp(x[:, 1])])

        self.write_clouds(positions, motion, np.arange(0, 10.1, 0.7))
        plot, body, files = script("mechanismPlot"), self.body(), caissonPlot.snapshots(self.case)
        before = plot.points_at(body, files, 0.75)
        after = plot.points_at(body, files, 1.0)
        first, second = caissonPlot.common_points(before, after)
        got = np.linalg.norm(second - first, axis=1) / 0.25
        # Exact: 0.5 exp(z0). The tolerance is that of the interpolation of a motion linear in time: rounding.
        np.testing.assert_allclose(got, 0.5 * np.exp(positions[:, 1]), atol=1e-9)

    def test_depth_that_was_not_written_is_refused_with_the_range(self):
        self.write_clouds(np.ones((4, 2)), np.zeros_like, [0, 5])
        with self.assertRaisesRegex(caissonPlot.PlotError, "2.500 m is outside .* from 0.500 to 1.000 m"):
            script("mechanismPlot").points_at(self.body(), caissonPlot.snapshots(self.case), 2.5)

    def test_triangles_keep_to_the_soil(self):
        r, z = np.meshgrid(np.concatenate([np.arange(0.025, 2.45, 0.05), np.arange(2.525, 5, 0.05)]),
                           np.arange(-2.975, 0, 0.05))
        heave = np.where(r < 2.45, 0.2 * (1 - r / 2.45), 0)     # a cone inside, level outside
        soil = np.column_stack([r.ravel(), (z + heave).ravel()])
        mesh = script("mechanismPlot").soil_triangles(self.body(), soil, tip=-1)
        used = mesh.triangles[~mesh.mask]
        corner_r, corner_z = np.abs(mesh.x[used]), mesh.y[used]
        across = (corner_r.min(axis=1) < 2.45) & (corner_r.max(axis=1) > 2.5) & (corner_z.mean(axis=1) > -1)
        self.assertEqual(np.count_nonzero(across), 0)
        # Area of both halves: 2 (4.95 x 2.95 + heave 2.45 x 0.1) less the wall's band of 0.1 x 1 with its neighbours.
        side = np.stack([mesh.x[used], mesh.y[used]], axis=-1)
        a, b = side[:, 1] - side[:, 0], side[:, 2] - side[:, 0]
        area = 0.5 * np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum()
        self.assertAlmostEqual(area, 2 * (4.975 * 2.95 + 2.45 * 0.1 - 0.1 * 1), delta=0.01 * area)

    def test_mean_of_a_linear_force_is_the_force_and_an_oscillation_vanishes(self):
        h = np.linspace(0.5, 2, 30001)
        middle, mean = script("forcePlot").mean_over(h, 1e6 * h + 2e5 * np.sin(2 * np.pi * h / 0.05), 0.1)
        np.testing.assert_allclose(mean, 1e6 * middle, rtol=1e-5)

    def test_missing_column_is_named_with_those_that_are_there(self):
        with self.assertRaisesRegex(caissonPlot.PlotError, "no column tipForce; there are Time penetration totalForce"):
            self.body().column("tipForce")


if __name__ == "__main__":
    unittest.main()
