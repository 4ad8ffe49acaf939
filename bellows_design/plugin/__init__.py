"""The CadQuery plugin: bellows parts in a chain of workplane calls, on plates, in notebooks.

    import cadquery as cq
    from bellows_design.plugin import bellows, plate, preview

    part = cq.Workplane().invoke(bellows("finger", bubble_thickness=1.2))
    hand = cq.Workplane("YZ").pushPoints([(0, 0), (25, 0)]).invoke(bellows("finger"))
    plate({"finger": 3, "prototype_2": 1}).export("plate.step")
    preview("finger")  # in a notebook: a table and the part in 3D

Importing this package changes nothing in CadQuery. Whoever prefers a method asks for it:

    from bellows_design.plugin import register

    register()
    part = cq.Workplane().bellows("finger")

and whoever wants designs and evaluations shown in 3D by themselves: ``%load_ext
bellows_design.plugin``.
"""

from __future__ import annotations

from bellows_design.plugin.notebooks import load_ipython_extension, unload_ipython_extension
from bellows_design.plugin.parts import METHOD, bellows, register
from bellows_design.plugin.plate import plate
from bellows_design.plugin.preview import Preview, preview

__all__ = [
    "METHOD",
    "Preview",
    "bellows",
    "load_ipython_extension",
    "plate",
    "preview",
    "register",
    "unload_ipython_extension",
]
