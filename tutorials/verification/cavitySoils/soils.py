#!/usr/bin/python3
"""Writes a soil round a cavity and the exact pressure that expands it into the dictionaries of a run.

    soils.py sand | cohesive | dilatant | clay  cylinder | sphere      (in the folder of the run; Allrun calls it)
"""

import re
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
import cavity  # noqa: E402


def replace(file, pairs):
    """Replaces each pattern, which must be there."""
    text = Path(file).read_text(encoding="utf-8")
    for pattern, replacement in pairs:
        text, count = re.subn(pattern, replacement, text, flags=re.DOTALL)
        if count == 0:
            sys.exit(f"{file}: nothing matches '{pattern}'")
    Path(file).write_text(text, encoding="utf-8")


def law(soil):
    """The law and its parameters, as constant/materialProperties has them."""
    if isinstance(soil, cavity.Clay):
        return "tresca", {"undrainedShearStrength": soil.strength}
    return "mohrCoulomb", {"frictionAngle": soil.friction, "dilatancyAngle": soil.dilatancy, "cohesion": soil.cohesion}


def write(soil, m):
    """The soil, its initial stress, the elastic ring, which answers u with the pressure 2 m G u/r, and the load."""
    name, parameters = law(soil)
    far = 2 * m * soil.E / (2 * (1 + soil.nu)) * 2 / 45
    replace("constant/materialProperties", [
        ("mohrCoulomb", name), (r"poissonsRatio   0\.25;", f"poissonsRatio   {soil.nu};"),
        (r"frictionAngle.*cohesion [^\n]*", "\n    ".join(f"{key} {value};" for key, value in parameters.items())),
        (r"youngsModulus   [24][0-9.]*e6;", f"youngsModulus   {far:.6g};")])
    replace("system/setMaterialPointsDict", [(r"stress [^\n]*", f"stress ({-soil.p0} {-soil.p0} {-soil.p0} 0);")])
    replace("system/controlDict", [(r"endTime +20;", f"endTime {soil.duration};"),
                                   (r"writeInterval +1;", f"writeInterval {soil.duration / 20};")])
    times, pressures = cavity.schedule(soil, m)
    if m == 1:
        rows = [f"({time:g} {pressure:.0f})" for time, pressure in zip(times, pressures)]
        replace("constant/pointLoads", [(r"table\s*\(.*?\n    \);", "table\n    (\n        " + "\n        ".join(rows) + "\n    );")])
    else:
        rates = np.diff(pressures) / np.diff(times)
        pieces = [f"t < {end:g} ? {pressure:.0f} + {rate:.0f}*(t - {begin:g})"
                  for begin, end, pressure, rate in zip(times, times[1:], pressures, rates)]
        replace("constant/pointLoads", [(r'p           "50e3"', 'p "' + " : ".join(pieces) + f' : {pressures[-1]:.0f}"')])


def main():
    if len(sys.argv) != 3 or sys.argv[1] not in cavity.SOILS or sys.argv[2] not in ("cylinder", "sphere"):
        sys.exit(__doc__)
    write(cavity.SOILS[sys.argv[1]], m=2 if sys.argv[2] == "sphere" else 1)


if __name__ == "__main__":
    main()
