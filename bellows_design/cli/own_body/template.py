"""A commented file of an own body to start from."""

from __future__ import annotations

TEMPLATE = """\
# A body of your own. Lengths in mm, pressures and stresses in MPa.
# Lines that begin with # are comments; keys in them are optional.
# Export the shape as STEP, and put it beside this file.
# letters, digits, _ and -, at most 64
name = "{name}"
# one line of text; optional
description = ""
# surfaces under pressure; without it the surface cavity, if there is one
# pressurised = ["cavity"]

# a solid and what it is made of; one such table for each part, and parts touch
[[parts]]
# names the part
name = "body"
# STEP file, from the folder of this file
step = "{name}.step"
# number of the solid in that file, from 0; optional
solid = 0
# name of a material of the library, a TOML file, or a table
material = "ecoflex_00_30"
# kg/m³; above 0, at most 30000; needed where gravity acts
# density_kg_m3 = 1070.0
# longest edge of the mesh in this part, mm; above 0, at most 1000; optional
# size = 1.0

# which faces carry which name; faces that nothing chooses are "outside"
[surfaces]
# name = a selector of CadQuery's: here the faces of least x
root = "<X"
# its rotation about y is the bending angle
tip = ">X"
# the faces of closed holes
cavity = {{ inner = true }}
# a surface by conditions that all hold; several such tables choose more faces
# [[surfaces.side]]
# a selector of CadQuery's
# select = "|Y"
# two opposite corners, mm; the centres of faces lie between them
# box = [[0.0, 1.0, 0.0], [40.0, 5.0, 10.0]]
# only faces of closed holes
# inner = false
# only faces of that part
# part = "body"

# what is held
[supports]
# surfaces that do not move
clamped = ["root"]
# plane surface = axis normal to it, along which it does not move; optional
# symmetry = {{ middle = "y" }}

# the load: a pressure, or else a volume
[load]
# MPa; at least -0.101325, at most 2
pressure = 0.01
# volume of the cavity in multiples of the undeformed one, instead of the pressure; at most 1000
# largest_volume = 3.0
# how many volumes on the way are read; at least 1, at most 200
# points = 12

# what is read at the tip (optional)
[tip]
# place whose displacement is read, mm; without it the mean of the surface tip
# point = [40.0, 0.0, 0.0]
# place where the chord to the tip begins, mm; without it the mean of the first clamped surface
# base = [0.0, 0.0, 0.0]

# the first mesh (optional)
[mesh]
# longest edge, mm; above 0, at most 1000; without it from volume and area
# size = 2.0
# distance from sharp edges within which no stress is reported, mm; at least 0, at most 100
# sharp_edge_radius = 0.4

# a film glued to a surface, which resists stretching and bends freely; as many as there are
# [[films]]
# name of the surface, or of that between two parts, "first|second"
# surface = "bottom"
# MPa; above 0, at most 1e+07
# young_modulus = 4100.0
# above -1, at most 0.5
# poisson_ratio = 0.3
# mm; above 0, at most 100
# thickness = 0.1
# whether it wrinkles where it is pressed together, instead of bearing compression
# wrinkles = true

# weight, which acts before any pressure
# [gravity]
# which way things fall
# direction = [0.0, 0.0, -1.0]
# m/s²; above 0, at most 1000
# acceleration = 9.80665

# a rigid plane without friction; as many as there are
# [[obstacles]]
# surface of the body that may not pass it
# surface = "outside"
# point on the plane, mm
# point = [0.0, 0.0, -5.0]
# normal of the plane, to the side on which the body is
# normal = [0.0, 0.0, 1.0]
"""


def body_template(name: str) -> str:
    """A commented TOML file for a body called ``name``."""
    return TEMPLATE.format(name=name)
