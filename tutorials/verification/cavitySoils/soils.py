#!/usr/bin/python3
"""Two soils round a cavity, and the exact pressure that expands it: writes them into the dictionaries of a run.

    soils.py cohesive | dilatant      (in the folder of the run; Allrun calls it)
"""

import re
import sys
from dataclasses import dataclass
from math import factorial
from pathlib import Path

import numpy as np


@dataclass(frozen=True)
class Soil:
    """Mohr-Coulomb soil under a pressure all round. Angles in degrees."""

    nu: float
    friction: float
    dilatancy: float
    cohesion: float
    p0: float
    E: float = 60e6

    def expansion(self, p):
        """a/a0 under the pressure p in a cylinder [Yu & Houlsby 1991]."""
        sine, psi, nu = np.sin(np.radians(self.friction)), np.sin(np.radians(self.dilatancy)), self.nu
        alpha, beta = (1 + sine) / (1 - sine), (1 + psi) / (1 - psi)
        Y = 2 * self.cohesion * np.cos(np.radians(self.friction)) / (1 - sine)
        gamma = alpha * (beta + 1) / ((alpha - 1) * beta)
        start = Y + (alpha - 1) * self.p0
        delta = start * (1 + nu) / ((1 + alpha) * self.E)
        ratio = (1 + alpha) * (Y + (alpha - 1) * p) / (2 * alpha * start)
        eta = np.exp((beta + 1) * (1 - 2 * nu) * (1 + nu) * start / (self.E * (alpha - 1) * beta))
        xi = 2 * (1 - nu) * delta / ((alpha - 1) * beta) * (
            alpha * beta + 1 - nu * (alpha + beta) / (1 - nu))
        series = sum(xi**n / factorial(n) * (ratio ** (n - gamma) - 1) / (n - gamma) for n in range(30))
        bracket = (1 - delta) ** ((beta + 1) / beta) - gamma / eta * series
        return (ratio**-gamma / bracket) ** (beta / (beta + 1))

    def pressure(self, growth):
        """The pressure at a/a0 between 1.01 and 2.2."""
        # up to where the bracket is still positive
        pressures = np.linspace(1.5, 17, 20000) * self.p0
        with np.errstate(invalid="ignore"):
            expansions = self.expansion(pressures)
        usable = np.flatnonzero(~(np.nan_to_num(expansions, nan=9) < 3))
        end = usable[0] if usable.size else pressures.size
        return np.interp(growth, expansions[:end], pressures[:end])


SOILS = {
    "cohesive": Soil(nu=0.25, friction=30, dilatancy=0, cohesion=10e3, p0=100e3),
    "dilatant": Soil(nu=0.3, friction=35, dilatancy=10, cohesion=0, p0=100e3),
}


def replace(file, pairs):
    """Replaces each pattern, which must be there."""
    text = Path(file).read_text(encoding="utf-8")
    for pattern, replacement in pairs:
        text, count = re.subn(pattern, replacement, text, flags=re.DOTALL)
        if count == 0:
            sys.exit(f"{file}: nothing matches '{pattern}'")
    Path(file).write_text(text, encoding="utf-8")


def main():
    if len(sys.argv) != 2 or sys.argv[1] not in SOILS:
        sys.exit(__doc__)
    soil = SOILS[sys.argv[1]]
    far = 2 * soil.E / (2 * (1 + soil.nu)) * 2 / 45  # as in ../cavityExpansion
    replace("constant/materialProperties", [
        (r"poissonsRatio   0\.25;", f"poissonsRatio   {soil.nu};"), (r"frictionAngle [^\n]*", f"frictionAngle {soil.friction};"),
        (r"dilatancyAngle [^\n]*", f"dilatancyAngle {soil.dilatancy};"), (r"cohesion [^\n]*", f"cohesion {soil.cohesion};"),
        (r"youngsModulus   2\.13333e6;", f"youngsModulus {far:.6g};")])
    replace("system/setMaterialPointsDict", [(r"stress [^\n]*", f"stress ({-soil.p0} {-soil.p0} {-soil.p0} 0);")])
    times = [0.2, 0.5, 1, 2, 4, 6, 10, 15, 20]
    rows = [f"(0 {soil.p0})"] + [f"({time} {soil.pressure(1 + time / 20):.0f})" for time in times]
    replace("constant/pointLoads", [(r"table\s*\(.*?\n    \);", "table\n    (\n        " + "\n        ".join(rows) + "\n    );")])


if __name__ == "__main__":
    main()
