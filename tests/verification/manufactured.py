"""A made-up solution: the loads that make a given smooth motion an equilibrium.

Positions, deformation gradient and stress are in closed form; only the divergence of the stress
is taken numerically, by central differences of eighth order.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from measures import Points

from solver import Ogden

WEIGHTS = {1: 4 / 5, 2: -1 / 5, 3: 4 / 105, 4: -1 / 280}
"""Central differences of eighth order: f'(0) = sum of w_k (f(k h) - f(-k h)) / h."""


@dataclass(frozen=True)
class Swirl:
    """Three shears in turn, each along one axis by a wave over the others, then a swelling.

    The shears keep the volume exactly; ``swelling`` is the amplitude of a wave along x added to
    x itself, which does not.
    """

    amplitude: float = 0.12
    swelling: float = 0.0

    def displacement(self, positions: Points) -> Points:
        """(k, 3), mm."""
        return self._place(positions)[0] - positions

    def gradient(self, positions: Points) -> Points:
        """Deformation gradients F (k, 3, 3)."""
        return self._place(positions)[1]

    def _place(self, positions: Points) -> tuple[Points, Points]:
        x = np.array(positions, float)
        gradient = np.broadcast_to(np.eye(3), (len(x), 3, 3)).copy()
        for axis, waves in SHEARS:
            phase = x @ waves + 0.3 * axis
            step = np.broadcast_to(np.eye(3), gradient.shape).copy()
            step[:, axis] += self.amplitude * np.cos(phase)[:, None] * waves
            x[:, axis] += self.amplitude * np.sin(phase)
            gradient = step @ gradient
        stretch = np.ones_like(x)
        stretch[:, 0] += 2 * self.swelling * np.cos(2 * x[:, 0])
        x[:, 0] += self.swelling * np.sin(2 * x[:, 0])
        return x, stretch[:, :, None] * gradient


SHEARS = (
    (0, np.array([0.0, 2.0, 1.3])),
    (1, np.array([1.7, 0.0, -2.1])),
    (2, np.array([-1.4, 2.3, 0.0])),
)
"""(axis, wave vector in rad/mm): the wave does not vary along the axis that it moves."""


@dataclass(frozen=True)
class Manufactured:
    """A motion of a body of ``material`` and the loads that hold it there."""

    motion: Swirl
    material: Ogden

    def pressure(self, positions: Points) -> Points:
        """Hydrostatic pressure q (k,), MPa: a wave if incompressible, else -K (J - 1)."""
        if np.isfinite(self.material.bulk_modulus):
            volume = np.linalg.det(self.motion.gradient(positions))
            return -self.material.bulk_modulus * (volume - 1)
        return 0.4 + 0.8 * np.sin(positions @ [1.1, -0.8, 1.9])

    def stress(self, positions: Points) -> Points:
        """First Piola-Kirchhoff stress (k, 3, 3), MPa, by the formula of the energy.

        tau = sum 2 mu / alpha (b^(alpha/2)) of the isochoric b, its deviator, minus q J.
        """
        gradient = self.motion.gradient(positions)
        volume = np.linalg.det(gradient)
        values, vectors = np.linalg.eigh(gradient @ np.swapaxes(gradient, 1, 2))
        stretches = np.sqrt(values) * volume[:, None] ** (-1 / 3)
        principal = sum(
            2 * mu / alpha * stretches**alpha
            for mu, alpha in zip(self.material.mu, self.material.alpha, strict=True)
        )
        principal -= principal.mean(axis=1, keepdims=True)
        principal -= (self.pressure(positions) * volume)[:, None]
        kirchhoff = np.einsum("kia,ka,kja->kij", vectors, principal, vectors)
        return kirchhoff @ np.swapaxes(np.linalg.inv(gradient), 1, 2)

    def body_force(self, positions: Points, step: float = 0.02) -> Points:
        """Minus the divergence of the stress, N/mm^3: (k, 3)."""
        force = np.zeros_like(positions)
        for axis, along in enumerate(step * np.eye(3)):
            for k, weight in WEIGHTS.items():
                ahead, behind = (
                    self.stress(positions + k * along),
                    self.stress(positions - k * along),
                )
                force -= weight / step * (ahead - behind)[:, :, axis]
        return force

    def traction(self, normal: tuple[float, float, float]) -> Callable[[Points], Points]:
        """Load on a plane face with an outward ``normal``: positions -> (k, 3), MPa."""
        return lambda positions: self.stress(positions) @ np.array(normal)
