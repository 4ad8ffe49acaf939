"""A chain among its surroundings, as points that carry forces: prepared once for many solves."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from bellows_design.errors import BellowsError
from bellows_design.force.chain.contact.model import Obstacles
from bellows_design.force.chain.finger.chain import Chain
from bellows_design.force.chain.finger.kinematics import Configuration
from bellows_design.force.chain.finger.points import Indices, Points
from bellows_design.force.chain.surroundings import LoadPoint, Surroundings
from solver.arrays import Reals

DEPTHS = 5
"""Heights at which the undeformed finger is compared with objects."""


@dataclass(frozen=True)
class LoadedChain:
    """A chain among surroundings.

    Attributes:
        chain: the finger.
        surroundings: what acts on it.
        contacts: points of its lower side that objects may touch; the last is the tip's edge.
        widths: length of finger that every one of them stands for, mm; at both ends that of
            others, too, as the tip's edge bears most of what a wall bears.
        carriers: points on which dead forces and weights act, then the tip's lower edge.
        dead: dead forces on the carriers (k, 2), N.
        weights: weights on them (k, 2), N.
    """

    chain: Chain
    surroundings: Surroundings
    contacts: Points
    widths: Reals
    carriers: Points
    dead: Reals
    weights: Reals

    @classmethod
    def of(cls, chain: Chain, surroundings: Surroundings) -> LoadedChain:
        """Prepare ``chain`` among ``surroundings``.

        Raises:
            BellowsError: A dead force is not on the finger, or an object reaches into the
                undeformed finger.
        """
        count = max(2, int(np.ceil(chain.length / surroundings.contact.spacing)) + 1)
        places = np.linspace(0.0, chain.length, count)
        widths = np.full(count, places[1])
        carriers, dead, weights = _carriers(chain, surroundings)
        loaded = cls(chain, surroundings, Points.of(chain, places), widths, carriers, dead, weights)
        _require_clear(loaded)
        return loaded

    @property
    def obstacles(self) -> Obstacles:
        """What the points may touch."""
        around = self.surroundings
        return Obstacles(around.objects, around.friction, around.contact)

    @property
    def pairs(self) -> tuple[int, int]:
        """Numbers of objects and of points that may touch them."""
        return len(self.surroundings.objects), len(self.widths)

    def dead_forces(self, load: LoadPoint) -> Reals:
        """On the carriers (k, 2), N."""
        return load.forces * self.dead + load.gravity * self.weights

    def loaded_points(self, touching: Indices) -> Points:
        """The carriers, then those of ``contacts`` that touch."""
        parts = zip(
            vars(self.carriers).values(), vars(self.contacts[touching]).values(), strict=True
        )
        return Points(*(np.concatenate(each) for each in parts))

    @cached_property
    def edge(self) -> Points:
        """The tip's lower edge."""
        return self.carriers[np.array([-1])]

    @property
    def at_rest(self) -> Configuration:
        """Where the undeformed sections are."""
        return Configuration.of(self.chain, np.zeros((len(self.chain.pieces), 3)))


def _carriers(chain: Chain, surroundings: Surroundings) -> tuple[Points, Reals, Reals]:
    """Points that carry dead forces, weights and the hold, with those forces."""
    direction = surroundings.gravity or (0.0, 0.0)
    loads = [(each.place, each.height, each.force) for each in surroundings.dead_forces]
    middles = (chain.joints[1:] + chain.joints[:-1]) / 2
    heavy = [
        (chain.root_length / 2, chain.root_weight),
        *((middle, piece.weight) for middle, piece in zip(middles, chain.pieces, strict=True)),
        (chain.length - chain.tip_length / 2, chain.tip_weight),
    ]
    heavy = [(place + weight.ahead, weight) for place, weight in heavy if weight.newtons]
    places = [place for place, *_ in loads] + [place for place, _ in heavy] + [chain.length]
    heights = [height for _, height, _ in loads] + [weight.height for _, weight in heavy] + [0.0]
    dead, weights = np.zeros((len(places), 2)), np.zeros((len(places), 2))
    for number, (*_, force) in enumerate(loads):
        dead[number] = force
    for number, (_, weight) in enumerate(heavy, len(loads)):
        weights[number] = weight.newtons * np.array(direction)
    return Points.of(chain, np.array(places), np.array(heights)), dead, weights


def _require_clear(loaded: LoadedChain) -> None:
    """Refuse objects inside the undeformed finger."""
    frames = loaded.at_rest.frames
    chain, places = loaded.chain, loaded.contacts.places
    stub = (places < chain.joints[0]) | (places > chain.joints[-1])
    tops = np.where(stub, chain.tip_height, chain.height)
    for number, each in enumerate(loaded.surroundings.objects, 1):
        for fraction in np.linspace(0, 1, DEPTHS):
            points = Points.of(chain, places, fraction * tops)
            depth = -each.gap(points.positions(frames))
            if depth.max() > 1e-6:
                raise BellowsError(
                    f"object {number} reaches {depth.max():.3g} mm into the undeformed finger, "
                    f"{places[depth.argmax()]:.3g} mm from its root; it must be outside"
                )
