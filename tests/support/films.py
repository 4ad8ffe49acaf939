"""Strips with a film on their underside, bent in the plane: closed form and problem."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize_scalar

from solver import Membrane, Mesh, Ogden, Problem, Supports

Array = NDArray[np.float64]


@dataclass(frozen=True)
class BentStrip:
    """A neo-Hookean, incompressible strip that ends bend to a ring, with a film at z = 0.

    In plane strain (no motion along y). ``shear_modulus`` in MPa; ``length``, ``width``, ``height``
    in mm; ``curvature``: angle between the ends over the length, rad/mm, negative with the film
    outside, where it is in tension.
    """

    shear_modulus: float
    length: float
    width: float
    height: float
    curvature: float
    film: Membrane | None

    @property
    def film_stiffness(self) -> float:
        """Force per width and strain in plane strain, N/mm."""
        if self.film is None:
            return 0.0
        return self.film.stiffness / (1 - self.film.poisson_ratio**2)

    def density(self, stretch: float, load: float = 1.0) -> float:
        """Energy per length and width at a ``stretch`` s of the underside, N/mm.

        A fibre at the height z is stretched to l = sqrt(s^2 + 2 k z), k being the curvature: so the
        volume is kept (R. S. Rivlin, Phil. Trans. R. Soc. A 242, 173, 1949), with the energy
        mu / 2 (l^2 + l^-2 - 2).
        """
        k, low = load * self.curvature, stretch**2
        high = low + 2 * k * self.height
        rubber = (high**2 - low**2) / (4 * k) + np.log(high / low) / (2 * k) - 2 * self.height
        return self.shear_modulus / 2 * rubber + self.film_stiffness / 2 * ((low - 1) / 2) ** 2

    def stretch(self, load: float = 1.0) -> float:
        """Stretch of the underside without an axial force, where the energy is least."""
        found = minimize_scalar(
            self.density,
            bounds=(0.5, 1.5),
            args=(load,),
            method="bounded",
            options={"xatol": 1e-12},
        )
        return float(found.x)

    @property
    def energy(self) -> float:
        """Energy of the whole strip with its film, N mm."""
        return self.density(self.stretch()) * self.length * self.width

    @property
    def film_energy(self) -> float:
        """That of the film, N mm."""
        strain = (self.stretch() ** 2 - 1) / 2
        return self.film_stiffness / 2 * strain**2 * self.length * self.width

    def moved(self, places: Array, load: float) -> Array:
        """Displacements (k, 3) at ``places`` (k, 3) of the undeformed strip; NaN along y."""
        if load == 0:
            return np.stack([0 * places[:, 0], np.full(len(places), np.nan), 0 * places[:, 0]], 1)
        k, stretch = load * self.curvature, self.stretch(load)
        angle, radius = k * places[:, 0], np.sqrt(stretch**2 + 2 * k * places[:, 2]) / k
        x, z = radius * np.sin(angle), radius * np.cos(angle) - stretch / k
        return np.stack([x - places[:, 0], np.full(len(places), np.nan), z - places[:, 2]], axis=1)

    def problem(self, mesh: Mesh) -> Problem:
        """Half of the strip, from its middle at x0 to the end x1, which is led."""
        symmetry = {"x0": 0, "y0": 1, "y1": 1}
        supports = Supports(symmetry=symmetry, prescribed={"x1": self.moved})
        films = () if self.film is None else (self.film,)
        return Problem(mesh, Ogden.neo_hooke(self.shear_modulus), supports, membranes=films)
