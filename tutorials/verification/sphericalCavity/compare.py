"""Pressure in the expanding spherical cavities against the exact one at the radius that they have reached: largest deviation."""

import sys

sys.path.insert(0, "..")
import cavity  # noqa: E402

cavity.compare({"sand": "spherical cavity in sand", "clay": "spherical cavity in clay"}, coarse=0.04, m=2)
