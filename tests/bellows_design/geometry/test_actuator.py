"""Solids of bellows against closed forms, and against the definition of every surface."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Any

import cadquery as cq
import numpy as np
import pytest
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from pydantic import ValidationError

from bellows_design.design.bellows_parameters import BellowsParameters
from bellows_design.design.design import Design
from bellows_design.design.indent import Indent
from bellows_design.design.port import Port
from bellows_design.design.shipped import load_design, shipped_designs
from bellows_design.geometry.actuator import full_body, half_body, printed_part
from bellows_design.geometry.named_solids import GeometryError, NamedSolid
from bellows_design.geometry.tessellation import tessellate
from bellows_design.study.paper import TABLE_4

Points = NDArray[np.float64]

PROTOTYPE_1 = load_design("prototype_1").bellows
SHARP = PROTOTYPE_1.model_copy(update={"inner_fillet": 0.0, "outer_fillet": 0.0})
DESIGNS: dict[str, Callable[[], Design]] = {
    **{name: lambda name=name: load_design(name) for name in shipped_designs()},
    **{result.label: result.build for result in TABLE_4 if result.overrides},
}
"""The shipped designs, and all of the paper's that are not among them."""


def changed(bellows: BellowsParameters, **changes: Any) -> BellowsParameters:
    return BellowsParameters(**{**bellows.model_dump(), **changes})


SHARP_BELLOWS = {
    "Prototype 1": SHARP,
    "one bubble": changed(SHARP, length=20, number_of_bubbles=1),
    "channel above the chambers' floor": changed(SHARP, length=25, tendon_thickness=1.9),
    "channel below the chambers' floor": changed(
        SHARP, length=25, tendon_thickness=1.0, bubble_thickness=1.7
    ),
    "tendon as wide as the bubbles": changed(SHARP, length=25, tendon_width=20),
    "tall and narrow": changed(
        SHARP, length=22.2, bubble_width=7.3, bubble_height=31.1, tendon_width=4.7, offset=2.2
    ),
    "a bubble flush with the tip": changed(SHARP, length=18, number_of_bubbles=2),
}


@dataclass(frozen=True)
class ClosedForm:
    """Volumes (mm³) and areas (mm²) of a whole bellows without fillets."""

    bellows: BellowsParameters

    @property
    def overlap_height(self) -> float:
        """Height that channel and chamber share, mm."""
        b = self.bellows
        top = b.tendon_height - b.tendon_thickness
        return top - max(b.tendon_thickness, b.bubble_thickness)

    @property
    def channel_length(self) -> float:
        """From the wall at the root to the middle of the last chamber, mm."""
        return self.bellows.bubble_middles[-1] - self.bellows.tendon_thickness

    @property
    def shared_length(self) -> float:
        """Length of the channel inside chambers, mm."""
        return (self.bellows.bubble_count - 0.5) * self.bellows.chamber_length

    @property
    def cavity(self) -> float:
        b = self.bellows
        chambers = b.bubble_count * math.prod(b.chamber_size)
        channel = self.channel_length * b.channel_width * b.channel_height
        return chambers + channel - self.shared_length * b.channel_width * self.overlap_height

    @property
    def envelope(self) -> float:
        b = self.bellows
        tendon = b.tendon_width * b.tendon_height
        bubbles = b.bubble_length * (b.bubble_width * b.bubble_height - tendon)
        return b.length * tendon + b.bubble_count * bubbles

    @property
    def middle_section(self) -> float:
        """Area of the cut at y = 0."""
        b = self.bellows
        outside = b.length * b.tendon_height
        outside += b.bubble_count * b.bubble_length * (b.bubble_height - b.tendon_height)
        inside = b.bubble_count * b.chamber_length * b.chamber_size[2]
        inside += self.channel_length * b.channel_height - self.shared_length * self.overlap_height
        return outside - inside


@cache
def sharp(name: str) -> tuple[NamedSolid, NamedSolid]:
    """Whole and half bellows without fillets."""
    bellows = SHARP_BELLOWS[name]
    return full_body(bellows, None), half_body(bellows, None)


@cache
def half(name: str) -> NamedSolid:
    design = DESIGNS[name]()
    return half_body(design.bellows, design.indent)


@cache
def printed(name: str) -> NamedSolid:
    design = DESIGNS[name]()
    return printed_part(design.bellows, design.indent, design.port)


def void(body: NamedSolid) -> cq.Solid:
    """The closed cavity of a whole body as a solid."""
    outer, inner = sorted(body.solid.Shells(), key=lambda shell: -shell.Area())
    assert outer.isValid() and inner.isValid()
    return cq.Solid.makeSolid(inner)


# Closed forms


@pytest.mark.parametrize("name", SHARP_BELLOWS)
def test_volumes_without_fillets_are_those_of_boxes(name: str) -> None:
    whole, half_of_it = sharp(name)
    form = ClosedForm(SHARP_BELLOWS[name])
    assert whole.solid.Volume() == pytest.approx(form.envelope - form.cavity, rel=1e-7)
    assert half_of_it.solid.Volume() == pytest.approx(whole.solid.Volume() / 2, rel=1e-7)
    assert abs(void(whole).Volume()) == pytest.approx(form.cavity, rel=1e-7)


@pytest.mark.parametrize("name", SHARP_BELLOWS)
def test_the_cavity_is_closed_and_all_its_walls_are_called_so(name: str) -> None:
    whole, _ = sharp(name)
    walls = {face for face in void(whole).Faces()}
    assert {face for face in whole.faces("cavity")} == walls
    assert set(whole.face_names) == {"cavity", "outside", "root", "tip"}


@pytest.mark.parametrize("name", SHARP_BELLOWS)
def test_root_tip_and_symmetry_have_the_areas_of_their_sections(name: str) -> None:
    whole, half_of_it = sharp(name)
    bellows = SHARP_BELLOWS[name]
    tendon = bellows.tendon_width * bellows.tendon_height
    for end in ("root", "tip"):
        assert whole.area(end) == pytest.approx(tendon, rel=1e-7)
        assert half_of_it.area(end) == pytest.approx(tendon / 2, rel=1e-7)
    section = ClosedForm(bellows).middle_section
    assert half_of_it.area("symmetry") == pytest.approx(section, rel=1e-7)


@pytest.mark.parametrize("radius", [0.8, 2.5])  # of an edge of 5 mm: rounded, fully rounded
def test_an_outer_fillet_leaves_the_closed_form_of_rounded_bubbles(radius: float) -> None:
    bellows = changed(SHARP, length=25, outer_fillet=radius, bubble_thickness=1.5)
    form = ClosedForm(bellows)
    a, b, c = (extent - 2 * radius for extent in (5.0, 20.0, 2 * 20.0))
    twice = a * b * c + 2 * (a * b + b * c + c * a) * radius  # a bubble and its mirror image in z
    twice += math.pi * (a + b + c) * radius**2 + 4 / 3 * math.pi * radius**3
    tendon = bellows.tendon_width * bellows.tendon_height  # narrow enough to miss the rounds
    bubbles = bellows.bubble_count * (twice / 2 - bellows.bubble_length * tendon)
    expected = bellows.length * tendon + bubbles - form.cavity
    assert full_body(bellows, None).solid.Volume() == pytest.approx(expected, rel=1e-6)


SHORT = changed(SHARP, length=25)
INDENTS = {
    "arc": Indent(depth=0.4, width=2.4),
    "half circle": Indent(depth=0.9, width=1.8),
    "rectangle": Indent(shape="rectangular", depth=0.5, width=3.0),
    "rounded rectangle": Indent(shape="rectangular", depth=0.5, width=3.0, fillet=0.3),
    "stadium": Indent(shape="rectangular", depth=0.8, width=1.4, fillet=0.7),
    "as long as the bubble": Indent(shape="rectangular", depth=0.5, width=5.0, fillet=0.5),
    "inside": Indent(side="inside", shape="rectangular", depth=0.7, width=1.6),
    "inside, rounded": Indent(side="inside", shape="rectangular", depth=0.7, width=1.6, fillet=0.3),
    "inside, full round": Indent(
        side="inside", shape="rectangular", depth=0.9, width=1.6, fillet=0.8
    ),
}


def groove_volume(indent: Indent, bellows: BellowsParameters) -> float:
    """What one indent takes away, mm³."""
    w, d, r = indent.width, indent.depth, indent.fillet
    if indent.shape == "arc":
        radius = (w**2 / 4 + d**2) / (2 * d)
        angle = 2 * math.asin(w / (2 * radius))
        return radius**2 / 2 * (angle - math.sin(angle)) * bellows.bubble_width
    if indent.side == "outside":
        return (w * d - 2 * (1 - math.pi / 4) * r**2) * bellows.bubble_width
    # Half of a rounded box and its mirror image; 0.4 mm of the floor stay on either side.
    a, b, c = (extent - 2 * r for extent in (w, bellows.chamber_size[1] - 0.8, 2 * d))
    twice = a * b * c + 2 * (a * b + b * c + c * a) * r
    return (twice + math.pi * (a + b + c) * r**2 + 4 / 3 * math.pi * r**3) / 2


@pytest.mark.parametrize("name", INDENTS)
def test_an_indent_takes_its_closed_form_from_under_every_bubble(name: str) -> None:
    indent = INDENTS[name]
    indent.check_fits(SHORT)
    taken = full_body(SHORT, None).solid.Volume() - full_body(SHORT, indent).solid.Volume()
    assert taken == pytest.approx(SHORT.bubble_count * groove_volume(indent, SHORT), rel=1e-6)


@pytest.mark.parametrize("side", ["outside", "inside"])
def test_an_indent_belongs_to_the_surface_it_is_cut_into(side: Any) -> None:
    indent = Indent(side=side, shape="rectangular", depth=0.5, width=1.6)
    plain, grooved = full_body(SHORT, None), full_body(SHORT, indent)
    across = 20.0 if side == "outside" else SHORT.chamber_size[1] - 0.8
    walls = 2 * 0.5 * across if side == "outside" else 2 * 0.5 * (across + 1.6)
    ends = 2 * 0.5 * 1.6 if side == "outside" else 0.0  # taken from the bubble's flanks
    grown = SHORT.bubble_count * (walls - ends)
    name, other = ("outside", "cavity") if side == "outside" else ("cavity", "outside")
    assert grooved.area(name) - plain.area(name) == pytest.approx(grown, rel=1e-6)
    assert grooved.area(other) == pytest.approx(plain.area(other), rel=1e-9)


# Every design of the paper, and the shipped ones


@pytest.mark.parametrize("name", DESIGNS)
@pytest.mark.thorough
def test_a_design_builds_one_valid_half_without_slivers(name: str) -> None:
    solid = half(name).solid
    assert solid.isValid() and solid.ShapeType() == "Solid"
    assert len(solid.Shells()) == 1  # the cavity is open at the plane of symmetry
    # Half of the strip of 0.2 mm between the fillets of chamber length 1.2 is the least.
    assert min(edge.Length() for edge in solid.Edges()) > 0.09
    assert min(face.Area() for face in solid.Faces()) > 0.1


@pytest.mark.parametrize("name", DESIGNS)
def test_every_face_lies_on_the_surface_it_is_named_after(name: str) -> None:
    """Distances to the rounded boxes of the definition, computed without the CAD kernel."""
    design = DESIGNS[name]()
    points = {own: _points_on(half(name), own) for own in set(half(name).face_names)}
    assert set(points) == {"cavity", "outside", "root", "tip", "symmetry"}
    for place, own in enumerate(("root", "symmetry")):
        assert np.abs(points[own][:, place]).max() < 1e-6
    assert np.abs(points["tip"][:, 0] - design.bellows.length).max() < 1e-6
    assert np.abs(cavity_distance(design, points["cavity"])).max() < 1e-5
    assert np.abs(outer_distance(design, points["outside"])).max() < 1e-5
    assert (cavity_distance(design, points["outside"]) > 0.39).all()  # at least one line of wall


@pytest.mark.parametrize("name", DESIGNS)
def test_no_loaded_reentrant_edge_is_sharp(name: str) -> None:
    """A sharp one would make the peak stress a property of the mesh."""
    import trimesh

    mesh = tessellate(half(name).solid)
    body = trimesh.Trimesh(mesh.vertices, mesh.triangles, process=False)
    edges = mesh.vertices[body.face_adjacency_edges].mean(axis=1)
    loaded = np.abs(cavity_distance(DESIGNS[name](), edges)) < 0.02
    reentrant = ~body.face_adjacency_convex
    assert np.count_nonzero(loaded & reentrant) > 100  # the fillets' own facets
    assert np.degrees(body.face_adjacency_angles[loaded & reentrant].max()) < 35


@pytest.mark.parametrize("name", shipped_designs())
@pytest.mark.thorough
def test_the_printed_part_has_one_cavity_with_one_opening_which_is_the_port(name: str) -> None:
    """It is a ball to topology; a stopper in the port leaves one closed cavity."""
    _assert_one_opening(printed(name), DESIGNS[name]())


@pytest.mark.slow
@pytest.mark.parametrize("name", DESIGNS)
def test_every_design_of_the_paper_can_be_printed_as_one_part(name: str) -> None:
    _assert_one_opening(printed(name), DESIGNS[name]())


@pytest.mark.parametrize("name", shipped_designs())
@pytest.mark.thorough
def test_the_printed_part_is_the_analysed_body_with_a_port(name: str) -> None:
    design, part = DESIGNS[name](), printed(name).solid
    bellows, port = design.bellows, design.port
    corners = tessellate(part).vertices
    lowest = (-port.depth, -bellows.bubble_width / 2, 0)
    highest = (bellows.length, bellows.bubble_width / 2, bellows.bubble_height)
    assert corners.min(axis=0) == pytest.approx(lowest, abs=1e-5)
    assert corners.max(axis=0) == pytest.approx(highest, abs=1e-5)
    beyond = cq.Solid.makeBox(50, 50, 50, cq.Vector(bellows.bubble_middles[0], -25, -25))
    tail = cq.Solid.makeBox(50, 50, 50, cq.Vector(bellows.bubble_middles[0], 0, -25))
    assert part.intersect(beyond).Volume() == pytest.approx(
        2 * half(name).solid.intersect(tail).Volume(), rel=1e-5
    )
    assert set(printed(name).face_names) == {"cavity", "outside", "root", "tip", "port"}


@pytest.mark.parametrize("chamber", [1.1, 1.4, 1.7])
@pytest.mark.thorough
def test_full_rounds_of_any_length_have_the_same_few_faces(chamber: float) -> None:
    """Half of 1.1 has no exact binary form; a strip of 1e-16 mm must not become a face."""

    def rounded(length: float, short_of_full: float) -> cq.Solid:
        bellows = changed(
            PROTOTYPE_1,
            length=25,
            number_of_bubbles=2,
            chamber_length=length,
            inner_fillet=length / 2 - short_of_full,
            outer_fillet=length / 2 + 1.5 - short_of_full,
        )
        return half_body(bellows, None).solid

    exact, snapped, reference = rounded(chamber, 0), rounded(chamber, 0.03), rounded(1.5, 0)
    assert len(exact.Faces()) == len(snapped.Faces()) == len(reference.Faces())
    assert min(edge.Length() for edge in (*exact.Edges(), *snapped.Edges())) > 0.1


def _assert_one_opening(part: NamedSolid, design: Design) -> None:
    assert part.solid.isValid() and len(part.solid.Shells()) == 1
    mesh = tessellate(part.solid)
    assert len(mesh.vertices) - len(mesh.triangles) / 2 == 2  # Euler: V - E + F of a sphere
    port = design.port
    mouth = cq.Vector(-port.depth - 1, 0, port.axis_height)
    stopper = cq.Solid.makeCylinder(port.tube_diameter / 2, 3, mouth, cq.Vector(1, 0, 0))
    plugged = part.solid.fuse(stopper)
    assert len(plugged.Solids()) == 1
    _, inner = sorted(plugged.Shells(), key=lambda shell: -shell.Area())
    air = abs(cq.Solid.makeSolid(inner).Volume())
    socket = math.pi * (port.tube_diameter / 2) ** 2 * (port.depth - 2)
    chambers = design.bellows.bubble_count * math.prod(design.bellows.chamber_size)
    assert 0.75 * chambers + socket < air < 1.25 * chambers + socket


def _points_on(body: NamedSolid, name: str) -> Points:
    """Points of a fine triangulation of the faces of that name, (k, 3)."""
    vertices = [
        vertex.toTuple() for face in body.faces(name) for vertex in face.tessellate(0.05, 0.3)[0]
    ]
    return np.array(vertices)


def rounded_distance(points: Points, lower: Points, upper: Points, radius: float) -> Points:
    """Signed distance (k,) of points (k, d) to a rounded box, mm; negative inside."""
    beyond = np.abs(points - (lower + upper) / 2) - ((upper - lower) / 2 - radius)
    outside = np.linalg.norm(np.maximum(beyond, 0), axis=1)
    return outside + np.minimum(beyond.max(axis=1), 0) - radius


def outer_distance(design: Design, points: Points) -> Points:
    """Signed distance (k,) to the bellows as if it were solid; exact on its surface."""
    b, r = design.bellows, design.bellows.bubble_fillet
    width, height = b.tendon_width / 2, b.tendon_height
    tendon = rounded_distance(
        points, np.array([0, -width, 0]), np.array([b.length, width, height]), 0
    )
    distances = [tendon]
    for middle in b.bubble_middles:
        half_size = np.array([b.bubble_length / 2, b.bubble_width / 2, b.bubble_height])
        centre = np.array([middle, 0, 0])
        rounded = rounded_distance(points, centre - half_size, centre + half_size, r)
        distances.append(np.maximum(rounded, -points[:, 2]))
    grooves = [_outside_groove(design, points, middle) for middle in b.bubble_middles]
    return np.maximum(np.min(distances, axis=0), -np.min(grooves, axis=0))


def _outside_groove(design: Design, points: Points, middle: float) -> Points:
    indent = design.indent
    if indent is None:
        return np.full(len(points), np.inf)
    assert indent.side == "outside"
    section = points[:, [0, 2]] - [middle, 0]
    if indent.shape == "arc":
        radius = (indent.width**2 / 4 + indent.depth**2) / (2 * indent.depth)
        return np.linalg.norm(section - [0, indent.depth - radius], axis=1) - radius
    corner = np.array([indent.width / 2, indent.depth])
    return rounded_distance(section, -corner, corner, indent.fillet)


def cavity_distance(design: Design, points: Points) -> Points:
    """Signed distance (k,) to the air; exact on its surface."""
    b = design.bellows
    x, y, z = b.chamber_size
    half_size = np.array([x, y, z]) / 2
    distances = [
        rounded_distance(points, centre - half_size, centre + half_size, b.chamber_fillet)
        for centre in (np.array([m, 0, b.bubble_height / 2]) for m in b.bubble_middles)
    ]
    wall, width, r = b.tendon_thickness, b.channel_width / 2, b.channel_fillet
    # A channel below the chambers' floor shows its end there: rounded, a little past the middle.
    past = r / 2 if wall < b.bubble_thickness else b.chamber_length / 2
    lower = np.array([wall, -width, wall])
    upper = np.array([b.bubble_middles[-1] + past, width, b.tendon_height - wall])
    return np.min([*distances, rounded_distance(points, lower, upper, r)], axis=0)


# Any admissible numbers


def rounded_floats(lowest: float, highest: float) -> st.SearchStrategy[float]:
    """Lengths as people type them, and as optimizers do."""
    floats = st.floats(lowest, max(lowest, highest))
    return floats.map(lambda value: round(value, 1)) | floats


@st.composite
def numbers(draw: st.DrawFn) -> dict[str, float]:
    """Twelve numbers of a short bellows, mostly admissible, often at the edge of it."""
    wall, tendon_wall = draw(rounded_floats(0.4, 2.5)), draw(rounded_floats(0.4, 2.5))
    chamber, distance = draw(rounded_floats(0.4, 6)), draw(rounded_floats(0.4, 4))
    offset, pitch = draw(rounded_floats(tendon_wall, 7)), chamber + 2 * wall + distance
    thicker = max(0, wall - tendon_wall)
    narrowest = max(2, 2 * tendon_wall + 0.5) + thicker
    width = draw(rounded_floats(max(4, narrowest + 2 * thicker), 25))
    height = draw(rounded_floats(max(4, narrowest + wall), 25))
    widest = width - 2 * thicker
    inner = draw(st.sampled_from([0.0, chamber / 2]) | rounded_floats(0.05, chamber / 2))
    inner = min(inner, width / 2 - wall, height / 2 - wall)
    outer = st.sampled_from([0.0, chamber / 2 + wall, inner + wall])
    return {
        "bubble_width": width,
        "bubble_height": height,
        "bubble_thickness": wall,
        "tendon_width": draw(st.just(widest) | rounded_floats(narrowest, widest)),
        "tendon_height": draw(rounded_floats(narrowest, height - wall)),
        "tendon_thickness": tendon_wall,
        "chamber_length": chamber,
        "bubble_distance": distance,
        "inner_fillet": inner,
        "outer_fillet": draw(outer | rounded_floats(0.05, chamber / 2 + wall)),
        "length": draw(rounded_floats(max(10, offset + pitch), offset + 3 * pitch)),
        "offset": offset,
    }


@st.composite
def indents(draw: st.DrawFn, bellows: dict[str, float]) -> dict[str, Any] | None:
    thinner = min(bellows["bubble_thickness"], bellows["tendon_thickness"])
    side = draw(st.sampled_from([None, "outside", "inside"]))
    if side is None or thinner < 0.5:
        return None
    chamber = bellows["chamber_length"]
    shape = draw(st.sampled_from(["arc", "rectangular"])) if side == "outside" else "rectangular"
    widest = chamber if side == "inside" else chamber + 2 * bellows["bubble_thickness"]
    width = draw(st.just(widest) | rounded_floats(0.2, widest))
    deepest = thinner - 0.4 if shape == "rectangular" else min(thinner - 0.4, width / 2)
    depth = draw(rounded_floats(0.05, deepest))
    most = width / 2 if side == "inside" else min(depth, width / 2)
    fillet = 0.0 if shape == "arc" else draw(st.sampled_from([0.0, most]))
    return {"side": side, "shape": shape, "depth": depth, "width": width, "fillet": fillet}


@st.composite
def parts(draw: st.DrawFn) -> tuple[dict[str, float], dict[str, Any] | None, dict[str, float]]:
    bellows = draw(numbers())
    diameter = draw(st.sampled_from([2.0, 4.0, 6.0]))
    return bellows, draw(indents(bellows)), {"tube_diameter": diameter}


def builds_or_is_refused(
    part: tuple[dict[str, float], dict[str, Any] | None, dict[str, float]],
) -> bool:
    """Whether the numbers are admitted; if so they must make one body with one closed cavity."""
    try:
        design = Design(name="any", bellows=part[0], indent=part[1], port=part[2])
    except ValueError as refusal:
        assert not isinstance(refusal, ValidationError)  # but the sentence made of it
        assert all(len(line) < 250 and "mm" in line for line in str(refusal).splitlines())
        return False
    whole = full_body(design.bellows, design.indent)
    assert whole.solid.isValid() and len(whole.solid.Shells()) == 2
    assert 0 < abs(void(whole).Volume()) < whole.solid.BoundingBox().DiagonalLength ** 3
    half_of_it = half_body(design.bellows, design.indent)
    assert half_of_it.solid.Volume() == pytest.approx(whole.solid.Volume() / 2, rel=1e-4)
    assert len(half_of_it.solid.Shells()) == 1
    part_solid = printed_part(design.bellows, design.indent, design.port).solid
    mesh = tessellate(part_solid)
    assert len(part_solid.Shells()) == 1
    assert len(mesh.vertices) - len(mesh.triangles) / 2 == 2
    return True


def count_built(examples: int) -> int:
    built = 0

    @settings(
        max_examples=examples,
        deadline=None,
        derandomize=True,
        database=None,
        phases=[Phase.generate],  # shrinking builds hundreds of solids
        suppress_health_check=list(HealthCheck),
    )
    @given(parts())
    def sweep(part: tuple[dict[str, float], dict[str, Any] | None, dict[str, float]]) -> None:
        nonlocal built
        built += builds_or_is_refused(part)

    sweep()
    return built


@pytest.mark.thorough
def test_admissible_numbers_build_and_all_others_are_refused() -> None:
    assert count_built(examples=8) >= 2


@pytest.mark.slow
def test_many_admissible_numbers_build_and_all_others_are_refused() -> None:
    assert count_built(examples=150) >= 40


UNJOINED = changed(
    PROTOTYPE_1,
    bubble_width=15.4, bubble_height=19.00570682161811, bubble_thickness=0.4,
    tendon_width=10.864626949403128, tendon_height=8.0, tendon_thickness=1.8695034351433502,
    chamber_length=3.3, bubble_distance=3.1, inner_fillet=1.65, outer_fillet=0.7,
    length=21.793383404850957, offset=3.1,
)  # fmt: skip
"""Admissible; OCCT 7.9 makes no solid of its fully rounded chambers and channel."""


def test_chambers_that_the_cad_kernel_cannot_join_are_refused_with_a_remedy_that_works() -> None:
    try:
        whole = full_body(UNJOINED, None)
    except GeometryError as refusal:
        assert "change inner_fillet = 1.65 mm to 1.55 mm" in str(refusal)
        whole = full_body(changed(UNJOINED, inner_fillet=1.55), None)
    assert whole.solid.isValid() and len(whole.solid.Shells()) == 2


@pytest.mark.parametrize("tube", [2.0, 4.0, 6.0])
def test_a_port_of_any_usual_tube_opens_the_cavity_once(tube: float) -> None:
    bellows = changed(PROTOTYPE_1, length=18, number_of_bubbles=1)
    design = Design(name="one", bellows=bellows, port=Port(tube_diameter=tube))
    _assert_one_opening(printed_part(bellows, None, design.port), design)
