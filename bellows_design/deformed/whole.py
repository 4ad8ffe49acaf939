"""The whole actuator of any model, and its surface in any state."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from bellows_design.deformed.closing import closed
from bellows_design.deformed.joined.chain import Chain
from bellows_design.deformed.joined.single import Single
from bellows_design.deformed.joined.state import ActuatorState
from bellows_design.deformed.surface import FlatSurface
from bellows_design.design.bellows_parameters import BellowsParameters
from bellows_design.design.design import Design
from solver.arrays import Reals
from solver.mesh.mesh import Mesh

Whole: TypeAlias = Chain | Single


def whole_of(design: Design, body: Mesh, ends: Mesh | None) -> Whole:
    """From the mesh of half of the actuator or of all of it, or from a cell's and its ends'."""
    return Single.of(body) if ends is None else Chain.of(design, body, ends)


def stress_of(whole: Whole, state: ActuatorState) -> tuple[Reals, ...]:
    """Von Mises stress at the nodes of the bodies, MPa."""
    return whole.values(state.body.von_mises, None if state.ends is None else state.ends.von_mises)


@dataclass(frozen=True)
class WholeSurface:
    """The surface of an actuator, flat triangle by flat triangle."""

    whole: Whole
    flat: FlatSurface

    @staticmethod
    def of(whole: Whole, bellows: BellowsParameters, state: ActuatorState) -> WholeSurface:
        """All that bounds it, closed where cell and ends join."""
        flat = FlatSurface.of(np.concatenate([*whole.assembled.surfaces.values()]))
        rest = whole.assembled.positions(whole.at_rest(bellows, state), flat.nodes)
        return WholeSurface(whole, FlatSurface(closed(flat.triangles, rest), flat.nodes))

    def at_rest(self, bellows: BellowsParameters, state: ActuatorState) -> Reals:
        """Its nodes (n, 3), mm, on the meshes of ``state``, without load."""
        placed = self.whole.at_rest(bellows, state)
        return self.whole.assembled.positions(placed, self.flat.nodes)

    def loaded(self, bellows: BellowsParameters, state: ActuatorState) -> Reals:
        """The same under load."""
        placed = self.whole.loaded(bellows, state)
        return self.whole.assembled.positions(placed, self.flat.nodes)

    def von_mises(self, state: ActuatorState) -> Reals:
        """Stress at its nodes (n,), MPa."""
        return self.whole.assembled.values(stress_of(self.whole, state), self.flat.nodes)
