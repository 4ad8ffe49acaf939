"""Decks: what stands in them, that they are the problem, and that CalculiX computes the same."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from calculix import calculix, displacement_by_calculix

from solver import (
    BodyForce,
    Contact,
    FoundationSpring,
    Membrane,
    Mesh,
    Ogden,
    PointForce,
    Problem,
    Supports,
    Traction,
    read_mesh,
    solve,
    write_deck,
)
from solver.errors import SolverError
from solver.exchange.abaqus.materials import (
    BULK_TO_SHEAR,
    SMALLEST_ALPHA,
    compressible,
    differences,
    material_lines,
)
from solver.material.law import Hyperelastic
from solver.material.mooney_rivlin import MooneyRivlin
from solver.problem.loads import nodal_forces

Boxes = Callable[..., Mesh]

needs_calculix = pytest.mark.skipif(calculix() is None, reason="CalculiX's ccx is not installed")


def blocks(path: Path) -> dict[str, list[str]]:
    """Lines of data of every keyword, under its first word."""
    found: dict[str, list[str]] = {}
    key = ""
    for line in path.read_text().splitlines():
        if line.startswith("*") and not line.startswith("**"):
            key = line.split(",")[0]
            found.setdefault(key, [])
        elif not line.startswith("**"):
            found[key].append(line)
    return found


def numbers(lines: list[str]) -> list[float]:
    return [float(text) for line in lines for text in line.split(",") if text.strip()]


def cantilever(
    box: Boxes, material: Hyperelastic, cells: tuple[int, int, int] = (6, 2, 2)
) -> Problem:
    mesh = box(cells, (6.0, 1.0, 1.0))
    return Problem(mesh, material, Supports(("x0",), {"y0": 1}), ("z1",))


# what an energy is ------------------------------------------------------------------------------


def energy_of(kind: str, values: list[float], stretches: np.ndarray) -> float:
    """Isochoric energy of an input file's constants at principal stretches whose product is 1.

    Written down from the manuals (Abaqus, CalculiX), apart from the code that writes them.
    """
    i1, i2 = (stretches**2).sum() - 3, (stretches**-2.0).sum() - 3
    name, _, order = kind.partition(", N=")
    if name == "OGDEN":
        pairs = np.reshape(values[: 2 * int(order)], (-1, 2))
        return float(sum(2 * mu / a**2 * ((stretches**a).sum() - 3) for mu, a in pairs))
    if name == "NEO HOOKE":
        return values[0] * i1
    if name == "MOONEY-RIVLIN":
        return values[0] * i1 + values[1] * i2
    if name == "YEOH":
        return sum(c * i1**k for k, c in enumerate(values[:3], start=1))
    terms = [(i, n - i) for n in range(1, int(order) + 1) for i in range(n, -1, -1)]
    return float(sum(c * i1**i * i2**j for c, (i, j) in zip(values, terms, strict=False)))


LAWS = [
    Ogden.neo_hooke(0.4, 9.0),
    Ogden.mooney_rivlin(0.2, 0.1, 9.0),
    Ogden.yeoh(0.2, -0.01, 0.003, bulk_modulus=9.0),
    Ogden.yeoh(0.2, 0.02),
    Ogden((0.3, 0.2), (2.0, -2.0), 9.0, higher=(0.02,)),
    Ogden((0.3,), (3.05,)),
    Ogden((0.19825, 3.2778), (3.05, -0.0054)),
    Ogden((0.4095, 0.003, 0.01), (1.3, 5.0, -2.0), 100.0),
    MooneyRivlin(0.2, 0.1, 0.01, 0.02, 0.003, 50.0),
]


@pytest.mark.parametrize("program", ["abaqus", "calculix"])
@pytest.mark.parametrize("material", LAWS, ids=str)
def test_the_constants_are_the_energy(material: Hyperelastic, program: str) -> None:
    head, *data = [
        line for line in material_lines("rubber", material, program) if line[:9] != "*MATERIAL"
    ]
    kind, values = head.removeprefix("*HYPERELASTIC, "), numbers(data)
    for stretch in (0.7, 0.95, 1.2, 1.6):
        for other in (stretch**-0.5, 1.0):
            stretches = np.array([stretch, other, 1 / (stretch * other)])
            tolerance = 1e-9
            if program == "calculix" and any(
                abs(alpha) < SMALLEST_ALPHA for alpha in getattr(material, "alpha", ())
            ):
                tolerance = SMALLEST_ALPHA**2 * np.abs(np.log(stretches)).max() ** 2 / 12
            expected = material.energy(np.log(stretches))
            assert energy_of(kind, values, stretches) == pytest.approx(
                expected, rel=tolerance + 1e-7
            )


@pytest.mark.parametrize("program", ["abaqus", "calculix"])
@pytest.mark.parametrize("material", LAWS, ids=str)
def test_the_bulk_modulus_is_that_of_the_manuals(material: Hyperelastic, program: str) -> None:
    """K = 2 / D1, the other D are zero, as many as there are terms; D1 = 0 is incompressible."""
    head, *data = [
        line for line in material_lines("rubber", material, program) if line[:9] != "*MATERIAL"
    ]
    order = {"NEO HOOKE": 1, "MOONEY-RIVLIN": 1, "YEOH": 3}.get(
        head.removeprefix("*HYPERELASTIC, ")
    ) or int(head.rpartition("=")[2])
    first, *others = numbers(data)[-order:]
    wanted = compressible(material, program)
    assert first == pytest.approx(0.0 if math.isinf(wanted) else 2 / wanted)
    assert not any(others) and all(len(line.split(",")) <= 8 for line in data)
    assert program == "abaqus" or wanted < math.inf


def test_what_calculix_has_not_is_said() -> None:
    rubber = Ogden((0.19825, 3.2778), (3.05, -0.0054))
    said = " ".join(differences(rubber, "calculix"))
    assert f"bulk modulus of {BULK_TO_SHEAR:g} shear moduli" in said
    assert "Ogden's law diverges" in said and "alpha = -0.0054" in said
    assert not list(differences(rubber, "abaqus"))
    assert not list(differences(Ogden.yeoh(1.0, 0.1, bulk_modulus=9.0), "calculix"))
    logarithmic = replace(Ogden.neo_hooke(1.0, 9.0), volumetric="logarithmic")
    assert "instead of K (J^2 - 1 - 2 ln J)" in " ".join(differences(logarithmic, "abaqus"))


@pytest.mark.parametrize(
    ("material", "sentence"),
    [
        (Ogden((1.0,), (0.0,)), "alpha = 0, Hencky's"),
        (Ogden((1.0,), (3.0,), higher=(0.1,)), "higher terms besides Ogden's with alpha = 3"),
        (Ogden.yeoh(1.0, 0.1, 0.1, 0.1), "up to the order 4"),
        (Ogden((1.0,) * 7, (3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0)), "7 terms"),
    ],
)
def test_energies_that_no_input_file_has_are_refused(
    material: Ogden, sentence: str, box: Boxes, tmp_path: Path
) -> None:
    with pytest.raises(SolverError, match=re.escape(sentence)):
        write_deck(tmp_path / "job.inp", cantilever(box, material))
    assert not list(tmp_path.iterdir())


# what a deck is -----------------------------------------------------------------------------------


@pytest.mark.parametrize("program", ["abaqus", "calculix"])
def test_the_deck_read_back_is_the_same_problem(
    program: str, box: Boxes, ninjaflex: Ogden, tmp_path: Path
) -> None:
    """Mesh, supports, pressure and material taken from the file alone give the same solution."""
    problem = cantilever(box, replace(ninjaflex, bulk_modulus=70.0))
    write_deck(tmp_path / "job.inp", problem, 0.003, program)
    mesh, found = read_mesh(tmp_path / "job.inp"), blocks(tmp_path / "job.inp")
    clamped, symmetry = [], {}
    for line in found["*BOUNDARY"]:
        name, first, last = (text.strip() for text in line.split(","))
        if (first, last) == ("1", "3"):
            clamped.append(name)
        else:
            symmetry[name] = int(first) - 1
    (load,) = found["*DSLOAD"]
    surface, kind, pressure = (text.strip() for text in load.split(","))
    values = numbers(found["*HYPERELASTIC"])
    terms = (len(values)) // 3
    pairs = np.reshape(values[: 2 * terms], (-1, 2))
    material = Ogden(tuple(pairs[:, 0]), tuple(pairs[:, 1]), 2 / values[2 * terms])
    again = Problem(mesh, material, Supports(tuple(clamped), symmetry), (surface,))
    assert kind == "P"
    expected, solved = solve(problem, 0.003), solve(again, float(pressure))
    # CalculiX's two terms for the one of alpha = -0.0054 differ by 2e-5 of the displacement
    tolerance = 1e-6 if program == "abaqus" else 5e-5
    largest = np.abs(expected.displacement).max()
    assert largest > 0.5
    assert solved.displacement == pytest.approx(expected.displacement, abs=tolerance * largest)


def test_elements_and_steps_are_those_of_each_program(
    box: Boxes, ninjaflex: Ogden, tmp_path: Path
) -> None:
    problem = cantilever(box, ninjaflex)
    write_deck(tmp_path / "abaqus.inp", problem, 0.01)
    write_deck(tmp_path / "calculix.inp", problem, 0.01, "calculix", title="a\nb")
    abaqus, other = ((tmp_path / f"{name}.inp").read_text() for name in ("abaqus", "calculix"))
    assert "TYPE=C3D10H," in abaqus and "TYPE=C3D10," in other
    assert "*STEP, NLGEOM=YES" in abaqus and "*NODE OUTPUT\nU, RF" in abaqus
    assert "*STEP, NLGEOM," in other and "*EL FILE\nS" in other
    assert other.startswith("*HEADING\na b\n") and "mm, N, MPa" in abaqus


def test_dead_loads_are_the_same_nodal_forces(box: Boxes, tmp_path: Path) -> None:
    problem = replace(
        cantilever(box, Ogden.neo_hooke(1.0)),
        loads=(
            Traction("x1", (0.0, 0.0, -0.01)),
            BodyForce((0.0, 0.0, -1e-4)),
            PointForce((6.0, 0.0, 0.0), (0.1, 0.0, 0.2)),
        ),
    )
    write_deck(tmp_path / "job.inp", problem)
    forces = np.zeros(problem.mesh.nodes.shape)
    for line in blocks(tmp_path / "job.inp")["*CLOAD"]:
        node, axis, value = line.split(",")
        forces[int(node) - 1, int(axis) - 1] = float(value)
    assert np.array_equal(forces, nodal_forces(problem.mesh, problem.loads))
    assert "*DSLOAD" not in (tmp_path / "job.inp").read_text()


def test_regions_have_their_own_materials(box: Boxes, tmp_path: Path) -> None:
    problem = cantilever(box, Ogden.neo_hooke(1.0))
    mesh = problem.mesh.with_regions({"core": np.arange(5), "skin": np.arange(9, 20)})
    stiff = {"skin": Ogden.mooney_rivlin(2.0, 1.0)}
    write_deck(tmp_path / "job.inp", replace(problem, mesh=mesh, materials=stiff))
    text = (tmp_path / "job.inp").read_text()
    for part, material in (("rest", "main"), ("core", "main"), ("skin", "skin")):
        assert f"*SOLID SECTION, ELSET={part}, MATERIAL={material}\n" in text
    assert text.count("*MATERIAL, NAME=") == 2
    assert "*MATERIAL, NAME=skin\n*HYPERELASTIC, MOONEY-RIVLIN\n2.0, 1.0, 0.0\n" in text
    read = read_mesh(tmp_path / "job.inp", regions=("core", "skin"))
    assert read.regions["skin"].tolist() == list(range(9, 20))


def test_a_motion_is_led_to_its_end(box: Boxes, tmp_path: Path) -> None:
    def pull(places: np.ndarray, load: float) -> np.ndarray:
        return np.full(places.shape, [0.5 * load, np.nan, np.nan])

    def turn(places: np.ndarray, load: float) -> np.ndarray:
        return np.full(places.shape, [np.sin(load), np.nan, np.nan])

    problem = replace(cantilever(box, Ogden.neo_hooke(1.0)), pressurised=())
    led = replace(problem, supports=Supports(("x0",), prescribed={"x1": pull}))
    write_deck(tmp_path / "job.inp", led)
    step = (tmp_path / "job.inp").read_text().partition("*STEP")[2]
    lines = re.findall(r"^(\d+), 1, 1, 0\.5$", step, re.MULTILINE)
    assert [int(node) - 1 for node in lines] == led.mesh.surface_nodes("x1").tolist()
    turned = replace(problem, supports=Supports(("x0",), prescribed={"x1": turn}))
    with pytest.raises(SolverError, match="'x1' does not grow in proportion"):
        write_deck(tmp_path / "job.inp", turned)


def test_contact_is_left_out_and_said(box: Boxes, tmp_path: Path) -> None:
    problem = replace(
        cantilever(box, Ogden.neo_hooke(1.0)),
        contacts=(Contact("z0", 0.01, axis=2, position=-1.0),),
    )
    (said,) = write_deck(tmp_path / "job.inp", problem, 0.01)
    assert said.startswith("1 contacts of walls") and "left out" in said
    assert f"** note: {said}" in (tmp_path / "job.inp").read_text()


def test_what_a_deck_cannot_say_is_refused(box: Boxes, cell: Mesh, tmp_path: Path) -> None:
    rubber = Ogden.neo_hooke(1.0)
    problem, path = cantilever(box, rubber), tmp_path / "job.inp"
    plane = Problem(cell, rubber, Supports(symmetry={"x0": 0, "y0": 1}), (), moving_plane="x1")
    for wrong, sentence in (
        (plane, "a moving plane turns by finite angles"),
        (replace(problem, springs=(FoundationSpring("z0", (0, 0, 1.0)),)), "springs cannot"),
        (replace(problem, membranes=(Membrane("z0", 10.0, 0.3, 0.1),)), "membranes cannot"),
    ):
        with pytest.raises(SolverError, match=sentence):
            write_deck(path, wrong)
    with pytest.raises(SolverError, match=r"must end in \.inp, got 'job\.txt'"):
        write_deck("job.txt", problem)
    with pytest.raises(SolverError, match="program must be abaqus or calculix, got 'ansys'"):
        write_deck(path, problem, program="ansys")  # type: ignore[arg-type]
    with pytest.raises(SolverError, match="finite number of MPa, got nan"):
        write_deck(path, problem, math.nan)
    named = problem.mesh.with_surfaces({"zwölf": problem.mesh.surfaces["z0"]})
    with pytest.raises(SolverError, match="'zwölf' cannot be a name"):
        write_deck(path, replace(problem, mesh=named))
    twice = problem.mesh.with_surfaces({"Z1": problem.mesh.surfaces["z0"]})
    with pytest.raises(SolverError, match="'Z1' and 'z1' are one name"):
        write_deck(path, replace(problem, mesh=twice))
    assert not list(tmp_path.iterdir())


# against CalculiX ---------------------------------------------------------------------------------


@needs_calculix
@pytest.mark.parametrize(
    "material",
    [
        Ogden.neo_hooke(0.4, 8.0),
        Ogden.mooney_rivlin(0.15, 0.05, 8.0),
        Ogden.yeoh(0.2, 0.01, 0.001, bulk_modulus=8.0),
        Ogden((0.4,), (3.05,), 8.0),
        MooneyRivlin(0.15, 0.05, 0.01, 0.0, 0.0, 8.0),
    ],
    ids=str,
)
def test_calculix_stretches_a_bar_as_we_do(
    material: Hyperelastic, box: Boxes, tmp_path: Path
) -> None:
    """Uniform states: whatever the elements, materials, faces and follower pressures agree.

    Pressure from within on one end pulls at it; CalculiX prints seven digits.
    """
    mesh = box((2, 1, 1), (2.0, 1.0, 1.0))
    problem = Problem(mesh, material, Supports(symmetry={"x0": 0, "y0": 1, "z0": 2}), ("x1",))
    solution = solve(problem, -0.3)
    theirs = displacement_by_calculix(problem, -0.3, tmp_path)
    assert solution.displacement[:, 0].max() > 0.3  # 15 % and more
    assert theirs == pytest.approx(solution.displacement, abs=2e-5)


@pytest.mark.slow
@needs_calculix
def test_calculix_bends_a_beam_as_we_do_on_finer_meshes(box: Boxes, tmp_path: Path) -> None:
    """Its elements have displacements only and are too stiff; less so on finer meshes.

    With a bulk modulus of 20 shear moduli by 11 %, then 3.1 %, and by 1.6 % on a third of the edge.
    """
    differences = []
    for number, cells in enumerate([(5, 1, 1), (10, 2, 2)]):
        problem = cantilever(box, Ogden.neo_hooke(0.4, 8.0), cells)
        folder = tmp_path / str(number)
        folder.mkdir()
        ours = solve(problem, 0.0008).displacement
        theirs = displacement_by_calculix(problem, 0.0008, folder)
        assert theirs is not None
        differences.append(np.abs(theirs - ours).max() / np.abs(ours).max())
    assert np.abs(ours).max() > 1.0
    assert differences[1] < 0.4 * differences[0] and differences[1] < 0.04
