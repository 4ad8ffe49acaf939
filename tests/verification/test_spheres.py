"""Why two columns of the sphere's closed form are left out."""

from __future__ import annotations

import pytest
from cases_spheres import OPTIONS, SHELLS, Shell, stretch_of

from solver import trace

NINJAFLEX_SHELLS = [shell for shell in SHELLS if shell.spherical < 2]


@pytest.mark.slow
@pytest.mark.parametrize("divisions", [4, 6])
@pytest.mark.parametrize("shell", NINJAFLEX_SHELLS, ids=lambda shell: shell.key)
def test_other_shapes_branch_off_from_a_ninjaflex_sphere_near_twice_its_radius(
    shell: Shell, divisions: int
) -> None:
    problem = shell.problem(1, divisions)
    walked = trace(problem, 1.0, OPTIONS, until=lambda at: stretch_of(problem, at) > 2.01, steps=30)
    maximum, branching = walked.limits[:2]
    assert (maximum.kind, branching.kind) == ("maximum", "bifurcation")
    assert 1.8 < stretch_of(problem, branching.point) < 2.1
