"""Bearing capacity of the smooth circular footing against the exact one: mean over 2 to 3 % of the radius."""

import sys

sys.path.insert(0, "..")
import verification as v  # noqa: E402

v.bearing_capacity("footing", 5.6893, column=3)
