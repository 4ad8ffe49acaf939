"""The path of a finger in a scene, from rest to the last pressure."""

from __future__ import annotations

import math
import time
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from bellows_design.design.design import Design
from bellows_design.design.scenes.scene import Scene
from bellows_design.force.chain.finger.chain import Chain
from bellows_design.force.chain.loaded_chain import LoadedChain
from bellows_design.force.chain.path import Path, follow
from bellows_design.force.chain.state import ChainState
from bellows_design.force.finger_law import FingerLaw
from bellows_design.force.scene.support import until_lost
from bellows_design.force.scene.surroundings import surroundings_of, weights_of
from bellows_design.geometry.ends import tip_stub

STROKE_STEPS = 16
"""At least so many steps of pressure make a stroke: its work is a sum over them."""


@dataclass(frozen=True)
class Solved:
    """The path of a finger in a scene.

    Attributes:
        design: The finger.
        scene: What stands around it.
        pressures: Asked for, MPa.
        law: Of its pieces.
        loaded: The chain in its surroundings.
        path: Its equilibria.
        seconds: Time spent on the path, s.
    """

    design: Design
    scene: Scene
    pressures: tuple[float, ...]
    law: FingerLaw
    loaded: LoadedChain
    path: Path
    seconds: float

    @classmethod
    def of(cls, design: Design, scene: Scene, pressures: Sequence[float], law: FingerLaw) -> Solved:
        """Follow the path from rest to the last pressure, past jumps to where it comes to rest."""
        started = time.perf_counter()
        chain = chain_of(design, law)
        surroundings = surroundings_of(scene, design.finger_length)
        path = follow(chain, surroundings, _with_steps(pressures)[0], jumps=True)
        path = until_lost(scene, path)
        loaded = LoadedChain.of(chain, surroundings)
        seconds = time.perf_counter() - started
        return cls(design, scene, tuple(pressures), law, loaded, path, seconds)

    @property
    def warnings(self) -> tuple[str, ...]:
        """Sentences on jumps, where there are several equilibria, on coils and extrapolation."""
        jumps = tuple(
            f"{jump.sentence.rstrip('.')}; the finger was followed to where it comes to rest."
            for jump in self.path.jumps
        )
        return (*self.law.warnings, *jumps, *self._coiled, *self._extrapolated)

    @property
    def _coiled(self) -> tuple[str, ...]:
        """Where more than a full turn meets an object, or itself."""
        first = next((each for each in self.path.steps if abs(each.tip[2]) > 2 * math.pi), None)
        if first is None:
            return ()
        return (
            f"from {first.pressure:.3g} MPa on the finger coils by more than a full turn: it runs "
            "through itself where a real one meets itself.",
        )

    @property
    def _extrapolated(self) -> tuple[str, ...]:
        """Where the laws do not reach."""
        return tuple(
            f"from {states[0].pressure:.3g} MPa on {what} bears moments beyond those that its law "
            "was computed for: it is extrapolated there."
            for what, states in (("half a bubble", self.beyond), ("root or tip", self.beyond_ends))
            if states
        )

    @property
    def beyond(self) -> tuple[ChainState, ...]:
        """States of the path for whose moments the law of half a bubble was not computed."""
        within = self.law.facts.within
        return tuple(each for each in self.path.steps if not within(each.pressure, each.loads))

    @property
    def beyond_ends(self) -> tuple[ChainState, ...]:
        """States of the path for whose moments the laws of root and tip were not computed."""
        within = self.law.facts.ends_within
        return tuple(each for each in self.path.steps if not within(each.pressure, each.loads))

    @property
    def states(self) -> tuple[ChainState, ...]:
        """At the pressures asked for, and the last good one where the path ended before."""
        _, places = _with_steps(self.pressures)
        reached = self.path.states
        asked = [reached[place] for place in places if place < len(reached)]
        return (*asked, self.path.last) if self.path.ending else tuple(asked)


def chain_of(design: Design, law: FingerLaw) -> Chain:
    """The finger of ``design`` with its weights and its fingertip."""
    stub = tip_stub(design)
    chain = Chain.of(
        design.bellows, law.piece, root=law.root, tip=law.tip, weights=weights_of(design)
    )
    return replace(chain, tip_length=stub.length, tip_height=stub.height)


def _with_steps(pressures: Sequence[float]) -> tuple[list[float], list[int]]:
    """The pressures with others between them that make a stroke of enough steps; their places."""
    longest, last = abs(pressures[-1]) / STROKE_STEPS, 0.0
    found, places = list[float](), list[int]()
    for pressure in pressures:
        count = max(1, int(np.ceil(abs(pressure - last) / longest - 1e-9)))
        found += [*np.linspace(last, pressure, count + 1)[1:-1].tolist(), pressure]
        places.append(len(found) - 1)
        last = pressure
    return found, places
