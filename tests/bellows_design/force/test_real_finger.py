"""A real finger's force, from its own unit cell."""

from __future__ import annotations

import pytest

from bellows_design.budget import Budget
from bellows_design.design import load_design, with_overrides
from bellows_design.design.scenes.blocked import Blocked
from bellows_design.design.scenes.free import Free
from bellows_design.force.curve import force_curve
from bellows_design.force.law.cell_law import cell_law
from bellows_design.force.law_of_design import finger_law
from bellows_design.force.scene.solved import Solved

PRESSURES = (0.02, 0.04)


@pytest.mark.slow
def test_a_blocked_prototype_pushes_by_its_cells_law_and_balances_its_energy() -> None:
    design = with_overrides(load_design("prototype_1"), ["load.pressure=0.04"])
    unhurried = Budget(mesh_seconds=3600.0, seconds=3600.0)
    law = finger_law(cell_law(design, budget=unhurried))
    found = force_curve(design, Blocked(), PRESSURES, law)
    assert found.converged and all(each.stable for each in found.curve)
    weak, strong = found.curve
    assert 0 < 2 * weak.force_n < strong.force_n  # it stiffens as its bubbles touch
    assert strong.contact
    assert strong.error is not None and 0 < strong.error.total < 20
    assert strong.max_von_mises_mpa is not None and strong.max_von_mises_mpa < 4
    free = force_curve(design, Free(), PRESSURES, law).last
    assert free.tip_position_mm[1] < -20 and free.volume_mm3 > strong.volume_mm3
    solved = Solved.of(design, Blocked(), PRESSURES, law)
    stored = solved.path.last.stored_energy - solved.path.steps[0].stored_energy
    # The work is a sum of trapezia over some twenty steps.
    assert found.pneumatic_work_mj == pytest.approx(stored, rel=5e-3)
