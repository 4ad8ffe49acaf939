"""A material of your own: from a tensile test to the angle and the stress of a finger made of it.

    python examples/own_material.py

Fits Yeoh's constants to measured points, makes a material and a design of them, and evaluates that
on the unit cell. ``bellows fit tests.csv -o mine.toml --yield-strength 6`` does the fit for you,
tries more models and says how well the tests determine them; constants from a paper are typed in
where those of the fit stand here. Units: mm, N, MPa, degrees; strains are fractions.
"""

from __future__ import annotations

import numpy as np

from bellows_design import Design, load_design
from bellows_design.evaluation import Evaluation, evaluate
from bellows_design.materials import Material

# Natural rubber with 8 % sulphur in uniaxial tension, up to 201 % strain:
# L. R. G. Treloar, Trans. Faraday Soc. 40, 1944, 59-70, in the numbers handed down since.
STRETCH = np.array([1.01, 1.12, 1.24, 1.39, 1.61, 1.89, 2.17, 2.42, 3.01])
STRESS = np.array([0.03, 0.14, 0.23, 0.32, 0.41, 0.50, 0.58, 0.67, 0.85])  # nominal

PRESSURE = 0.01  # the shipped finger is made for 0.1 MPa, of a material nine times as stiff


def stress_of_each_term(stretch: np.ndarray) -> np.ndarray:
    """Nominal stress (n, 3) in uniaxial tension for c10, c20 and c30 of 1 MPa each.

    W = c10 (I1 - 3) + c20 (I1 - 3)^2 + c30 (I1 - 3)^3 with I1 = l^2 + 2 / l; stress dW/dl.
    """
    invariant = stretch**2 + 2 / stretch - 3
    slope = 2 * (stretch - stretch**-2)
    return np.stack([slope, 2 * slope * invariant, 3 * slope * invariant**2], axis=1)


def fitted() -> Material:
    """The constants enter linearly, so that least squares find them at once.

    A material is refused if it is unstable within the strains of the tests: ``valid_strain``, the
    lowest and the highest principal strain. In tension the lowest is that of the two sides.
    """
    constants, *_ = np.linalg.lstsq(stress_of_each_term(STRETCH), STRESS, rcond=None)
    c10, c20, c30 = (float(constant) for constant in constants)
    return Material(
        name="my_rubber",
        model="yeoh",
        c10=c10,
        c20=c20,
        c30=c30,
        yield_strength=6.3,  # decides what is approved; rubber has no yield: the highest stress
        elongation_at_break=660,  # %
        valid_strain=(float(STRETCH.max() ** -0.5 - 1), float(STRETCH.max() - 1)),
        source="own fit to Treloar 1944, uniaxial tension only",
    )


def finger_of(material: Material) -> Design:
    """The shipped finger, of another material and for another pressure; all bounds are checked."""
    return Design.of(
        load_design("finger").model_dump()
        | {"name": "my_finger", "material": material, "load": {"pressure": PRESSURE}}
    )


def evaluated() -> Evaluation:
    """A quarter of a bubble in the middle of the finger, and a short actuator for the ends."""
    return evaluate(finger_of(fitted()), "unit-cell")


def main() -> None:
    """Print the material, then what the finger does."""
    found = evaluated()
    material, error = found.design.material, found.error_estimate
    model = stress_of_each_term(STRETCH) @ (material.mu[0] / 2, *material.higher)
    print(f"shear modulus  {material.initial_shear_modulus:.3f} MPa")
    print(f"largest misfit {np.abs(model - STRESS).max():.3f} MPa of {STRESS.max():.2f} MPa")
    print(f"{found.message} ({found.model.name}, {found.design.bellows.bubble_count} bubbles)")
    print(f"bending angle  {found.bending_angle_deg:.1f}° ± {error.bending_angle_percent:.1f} %")
    print(f"highest stress {found.max_von_mises_mpa:.3f} MPa ± {error.max_von_mises_percent:.1f} %")
    print(f"largest strain {100 * found.strain.highest:.0f} %")
    for warning in found.warnings:
        print(f"warning: {warning}")


if __name__ == "__main__":
    main()
