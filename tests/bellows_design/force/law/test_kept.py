"""Laws in the store: found again as they were, counted and removed like evaluations."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from made_up_law import AT_REST, MadeUp
from meshes import bellows_cell_mesh

from bellows_design.budget import DEFAULT
from bellows_design.design.overrides import with_overrides
from bellows_design.design.shipped import load_design
from bellows_design.force.law.ends import EndPiece
from bellows_design.force.law.errors import LawError
from bellows_design.force.law.half_bubble import CellLaw, Effort
from bellows_design.force.law.interpolation.tabulated import TabulatedLaw
from bellows_design.force.law.kept import find, keep, key_of_extension, key_of_law
from bellows_design.store.store import Store

DESIGN = load_design("finger")
KEY = key_of_law(DESIGN, 0.01, DEFAULT)
LOADS = np.array([[-31.0, -1.0, 0.3], [12.0, 0.1, 0.0]])

END = EndPiece(
    length=10.0,
    pressures=np.array([0.0, 0.1]),
    moments=np.array([-40.0, 0.0, 20.0]),
    motion=np.full((2, 3, 2), 0.1),
    compliance=np.full((2, 3, 2, 2), np.diag([0.01, 0.02])),
    rate=np.full((2, 3, 2), 0.3),
    volumes=np.array([AT_REST, 310.0]),
    reaches=np.array([[-40.0, 20.0], [-40.0, 20.0]]),
)


@pytest.fixture(scope="module")
def law() -> CellLaw:
    table = MadeUp(stiffer=0.7).table(3, 5)
    return CellLaw(
        design=DESIGN,
        tabulated=TabulatedLaw(10.0, table, 1.02, AT_REST, 0.05),
        root=END,
        tip=replace(END, softening=1.1),
        free_rotation=0.3,
        tolerance=0.01,
        stress_factor=1.5,
        error=LawError(1e-3, 2e-3, 3e-3, None),
        mesh=bellows_cell_mesh(),
        effort=Effort(7, 0.5),
    )


def test_a_law_is_found_again_as_it_was(tmp_path: Path, law: CellLaw) -> None:
    store = Store(tmp_path)
    assert find(store, KEY, DESIGN) is None
    keep(store, KEY, law)
    again = find(store, KEY, DESIGN)
    assert again is not None
    for part in (lambda each: each, lambda each: each.root, lambda each: each.tip):
        ours, theirs = (part(each).response(0.04, LOADS) for each in (law, again))
        assert (ours.motion == theirs.motion).all()
        assert (ours.compliance == theirs.compliance).all()
    assert again.error == law.error
    assert again.design is DESIGN


def test_a_law_of_another_tolerance_or_design_is_not_found(tmp_path: Path, law: CellLaw) -> None:
    store = Store(tmp_path)
    keep(store, KEY, law)
    other = load_design("prototype_1")
    for key in (key_of_law(DESIGN, 0.02, DEFAULT), key_of_law(other, 0.01, DEFAULT)):
        assert find(store, key, DESIGN) is None


def test_a_law_is_found_whatever_stands_around_the_finger_or_judges_it() -> None:
    for other in (
        "scenes={a={kind='free'}}", "limits.max_von_mises=2", "printer=prusa_mk4", "name=other",
        "mount={kind='flange'}",
    ):  # fmt: skip
        assert key_of_law(with_overrides(DESIGN, [other]), 0.01, DEFAULT) == KEY
    for other in ("load.pressure=0.09", "material.mu=[0.9, 0.4]", "bubble_width=21"):
        assert key_of_law(with_overrides(DESIGN, [other]), 0.01, DEFAULT) != KEY


def test_an_extended_law_has_a_key_of_its_own() -> None:
    keys = {
        key_of_extension(KEY, moments, pressures).text
        for moments in ((-70.0, 0.0), (-60.0, 0.0))
        for pressures in (None, (0.05, 0.1))
    }
    assert len({KEY.text, *keys}) == 5


def test_laws_are_counted_and_removed_with_the_evaluations(tmp_path: Path, law: CellLaw) -> None:
    store = Store(tmp_path)
    keep(store, KEY, law)
    assert store.holdings().results == store.holdings().usable == 1
    assert store.clear() == 0
    assert store.holdings().results == 0
    assert find(store, KEY, DESIGN) is None


def test_nothing_is_looked_for_or_kept_without_a_store(law: CellLaw) -> None:
    keep(None, KEY, law)
    assert find(None, KEY, DESIGN) is None


def test_where_no_neighbour_stops_it_the_half_bubble_stays_as_soft_as_it_was(law: CellLaw) -> None:
    pressed = np.array([[-55.0, 0, 0]])
    outer = law.without_contact.response(0.05, pressed).compliance[0, 0, 0]
    inner = law.response(0.05, pressed).compliance[0, 0, 0]
    assert outer > 2 * inner
    assert law.touching(0.05, pressed)
    assert not law.touching(0.05, -pressed)


def test_the_stress_is_that_of_the_piece_under_the_largest_one(law: CellLaw) -> None:
    stress, error = law.stress(0.04, np.array([[-40.0, 0, 0], [10.0, 0, 0]]))
    assert stress == pytest.approx(1.5 * 40 / 20, rel=0.02)
    assert error is None
    assert replace(law, stress_factor=3.0).stress(0.04, LOADS)[0] == 2 * law.stress(0.04, LOADS)[0]
