"""A bellows actuator as a design script: change the numbers, look, repeat.

Open it in CQ-editor, or hand it to cq-cli, which sets any of the numbers from outside:

    cq-cli --codec step --infile design_script.py --outfile part.step \\
        --params "bubble_width:18;indent_depth:0"

On its own it writes the checked mesh: ``python design_script.py part.stl``.
Lengths are in mm; ``bellows_design/design/bellows_parameters.py`` says what each means.
"""

import cadquery as cq

from bellows_design.design import BellowsParameters, Design, Indent, Port
from bellows_design.plugin import bellows

bubble_width = 20.0
bubble_height = 20.0
bubble_thickness = 1.2
tendon_width = 6.0
tendon_height = 6.0
tendon_thickness = 1.6
chamber_length = 1.4
bubble_distance = 1.2
inner_fillet = 0.7
outer_fillet = 1.9
length = 50.0
offset = 5.0
indent_depth = 0.4  # 0: no indent
indent_width = 2.4
tube_diameter = 4.0

design = Design(
    name="design_script",
    bellows=BellowsParameters(
        bubble_width=bubble_width,
        bubble_height=bubble_height,
        bubble_thickness=bubble_thickness,
        tendon_width=tendon_width,
        tendon_height=tendon_height,
        tendon_thickness=tendon_thickness,
        chamber_length=chamber_length,
        bubble_distance=bubble_distance,
        inner_fillet=inner_fillet,
        outer_fillet=outer_fillet,
        length=length,
        offset=offset,
    ),
    indent=Indent(depth=indent_depth, width=indent_width) if indent_depth else None,
    port=Port(tube_diameter=tube_diameter),
)
part = cq.Workplane().invoke(bellows(design))

if "show_object" in globals():
    show_object(part)  # type: ignore[name-defined]  # noqa: F821
elif __name__ == "__main__":
    import sys

    from bellows_design.export.formats import write_part
    from bellows_design.pipeline import build_part

    if len(sys.argv) != 2:
        sys.exit("usage: python design_script.py part.stl")
    write_part(build_part(design), sys.argv[1])
