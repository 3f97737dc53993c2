"""Bearing capacity of the rough circular footing against the exact one: mean over 2 to 3 % of the radius."""

import sys

sys.path.insert(0, "..")
import verification as v  # noqa: E402

# force on the base alone: the sides adhere, too
v.bearing_capacity("rough footing", 6.0482, column=4)
