"""Cavities that a pressure expands from 1 m of radius: exact pressures, and how runs are read. SI units.

m is 1 for a cylinder and 2 for a sphere.
"""

import re
from dataclasses import dataclass
from math import factorial

import numpy as np
import verification as v


@dataclass(frozen=True)
class Sand:
    """Mohr-Coulomb soil under a pressure all round. Angles in degrees."""

    nu: float
    friction: float
    dilatancy: float
    cohesion: float
    p0: float
    E: float = 60e6
    duration: float = 20  # of runs [s]

    def pressure(self, growth, m=1):
        """The pressure at a/a0 up to 2.5 [Yu & Houlsby 1991]."""
        sine, psi, nu = np.sin(np.radians(self.friction)), np.sin(np.radians(self.dilatancy)), self.nu
        alpha, beta = (1 + sine) / (1 - sine), (1 + psi) / (1 - psi)
        Y = 2 * self.cohesion * np.cos(np.radians(self.friction)) / (1 - sine)
        start = Y + (alpha - 1) * self.p0
        gamma = alpha * (beta + m) / (m * (alpha - 1) * beta)
        delta = start * (1 + nu) / ((m + alpha) * self.E)
        eta = np.exp((beta + m) * (1 - 2 * nu) * (1 + (2 - m) * nu) * start / (self.E * (alpha - 1) * beta))
        xi = (1 - nu**2 * (2 - m)) * (1 + m) * delta / ((1 + nu) * (alpha - 1) * beta) * (
            alpha * beta + m * (1 - 2 * nu) + 2 * nu - m * nu * (alpha + beta) / (1 - nu * (2 - m)))
        # R of the paper: 1 where the wall yields, after an elastic rise from p0
        ratio = np.geomspace(1, 1e3, 20000)
        series = sum(xi**n / factorial(n) * (ratio ** (n - gamma) - 1) / (n - gamma) for n in range(30))
        bracket = (1 - delta) ** ((beta + m) / beta) - gamma / eta * series
        below = slice(0, np.argmax(np.append(bracket, 0) <= 0))  # the limit pressure
        expansion = (ratio[below] ** -gamma / bracket[below]) ** (beta / (beta + m))
        pressure = (ratio[below] * alpha * (1 + m) / (m + alpha) * start - Y) / (alpha - 1)
        return np.interp(growth, np.append(1, expansion), np.append(self.p0, pressure))


@dataclass(frozen=True)
class Clay:
    """Incompressible Tresca soil under a pressure all round; runs have nu in the place of 0.5 at the same G."""

    strength: float
    p0: float
    nu: float = 0.49
    E: float = 60e6
    duration: float = 5  # of runs [s]: steps are a quarter of those of sand

    def pressure(self, growth, m=1):
        """The pressure at a/a0: the difference of the stresses, 2(m+1) G ln(r/r0) or 2 strength, in equilibrium."""
        G = self.E / (2 * (1 + self.nu))
        # y = 1-(r0/r)^(m+1) goes as 1/r^(m+1) from the wall outwards; at the edge of the plastic zone it is `edge`
        y, edge = 1 - np.asarray(growth, float) ** -(m + 1), 1 - np.exp(-self.strength / G)
        n = np.arange(1, 60)
        dilogarithm = np.sum(np.minimum(y, edge)[..., None] ** n / n**2, axis=-1)
        plastic = np.log(np.maximum(y / edge, 1))
        return self.p0 + 2 * m / (m + 1) * (G * dilogarithm + self.strength * plastic)


SOILS = {
    "sand": Sand(nu=0.25, friction=38, dilatancy=1, cohesion=0, p0=50e3),
    "cohesive": Sand(nu=0.25, friction=30, dilatancy=0, cohesion=10e3, p0=100e3),
    "dilatant": Sand(nu=0.3, friction=35, dilatancy=10, cohesion=0, p0=100e3),
    "clay": Clay(strength=100e3, p0=100e3),
}


def schedule(soil, m=1):
    """Times [s] and pressures of the exact solution: the cavity grows by (t/duration)^2 of its radius, smoothly from rest."""
    share = np.append([0, 0.0125, 0.025, 0.0375, 0.05, 0.075], np.linspace(0.1, 1, 19))
    return soil.duration * share, soil.pressure(1 + share**2, m)


def wall(run, points, m=1):
    """The radius of the cavity as each loaded point has it: the soil between the wall and the points keeps its volume."""
    loaded = v.read_list(run / f"{points.time:g}" / "lagrangian/materialPoints/load")[:, 0] >= 0
    now, first = (points.r, points.R) if m == 1 else (np.hypot(points.r, points.z), np.hypot(points.R, points.Z))
    return ((now ** (m + 1) - first ** (m + 1) + 1) ** (1 / (m + 1)))[loaded]


def cylinder(run):
    """Radius of a cylindrical cavity and the pressure in it at the written times."""
    text = (run / "constant/pointLoads").read_text(encoding="utf-8").split("table")[1]
    table = np.array(re.findall(r"\(([0-9.]+) +([0-9.]+)\)", text), float)
    radius, pressure = [], []
    for points in v.written(run):
        radius.append(wall(run, points).mean())
        pressure.append(np.interp(points.time, *table.T))
    return np.array(radius), np.array(pressure)


def deviation(soil, radius, pressure, m=1):
    """Largest deviation of the pressure from the exact one at the radius reached, beyond a/a0 = 1.05."""
    grown = radius > 1.05
    return np.abs(pressure / soil.pressure(radius, m) - 1)[grown].max()


def history(run, soil, m=1):
    """Radius of a cavity and the pressure in it at the written times."""
    if m == 1:
        return cylinder(run)
    written = v.written(run)
    radius = [wall(run, points, m).mean() for points in written]
    return np.array(radius), np.interp([points.time for points in written], *schedule(soil, m))


def compare(titles, coarse, m=1):
    """Draws the pressure in cavities in several soils against the exact one at the radius reached, and reports the
    deviations under the soils' titles. In clay `coarse` is the target of runs below 20 cells, 0.01 of all others."""
    names = list(titles)
    runs = v.folders()
    figure, axes = v.picture("radius of the cavity/initial radius [-]", "pressure/initial pressure [-]")
    growth = np.linspace(1, 2.1, 300)
    errors = {}
    for name, marker in zip(names, ".x+"):
        soil = SOILS[name]
        errors[name] = []
        for k, run in enumerate(runs):
            radius, pressure = history(run / name / run.name, soil, m)
            errors[name].append(deviation(soil, radius, pressure, m))
            label = f"{v.cells(run)} cells, {name}" if name == names[0] or run == runs[-1] else None
            axes.plot(radius, pressure / soil.p0, marker, color=f"C{k}", markersize=4, label=label)
        axes.plot(growth, soil.pressure(growth, m) / soil.p0, "k-", linewidth=0.8, label="exact" if name == names[0] else None)
    v.save(figure, axes)
    for name in names:
        own = [run / name / run.name for run in runs]
        target = coarse if name == "clay" and v.cells(runs[-1]) < 20 else 0.01
        v.report(f"{titles[name]}: pressure", own, errors[name], target, last=name == names[-1])
