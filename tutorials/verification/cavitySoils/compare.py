"""Pressure in the expanding cavities against the exact one at the radius that they have reached: largest deviation."""

import sys

sys.path.insert(0, "..")
import cavity  # noqa: E402

cavity.compare({"cohesive": "cavity in cohesive soil", "dilatant": "cavity in dilatant soil", "clay": "cavity in clay"},
               coarse=0.03)
