"""Material laws."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from hard_bodies import (
    NEO_HOOKE,
    NINJAFLEX,
    THREE_PLANES,
    TIGHT,
    Points,
    cantilever,
    distance,
    solved,
    stretched,
)
from hard_case import Finding, HardCase, at_most, below, true, within
from meshes import box_mesh

from solver import Ogden, Problem, Solution, Supports, Traction, reaction, solve
from solver.kernels.hyperelastic import principal_response
from solver.kernels.tensors import spectrum, to_global_axes
from solver.material.ogden import packed

LOGS = ([0.3, 0.1, -0.4], [1.9, -0.7, -1.2], [1e-6, 1e-6, -2e-6], [0.8, 0.8, -1.6])
SMALL = [sign * 10.0**-k for k in range(2, 17) for sign in (1, -1)]
ROUNDING = 1e-13


def vanishing_exponent() -> tuple[Finding, ...]:
    """Energy, stress and tangent near alpha = 0, and whole solves there."""
    slopes = [
        float(np.abs(of(alpha) / of(0.0) - 1).max()) / (abs(alpha) + ROUNDING)
        for of in (_energies, _stresses, _stiffnesses)
        for alpha in SMALL
    ]
    problems = {a: cantilever(box_mesh((2, 1, 1)), Ogden((3.0,), (a,))) for a in WHOLE}
    found = {alpha: solved(problem, 0.2).displacement for alpha, problem in problems.items()}
    far = {alpha: distance(found[alpha], found[0.0]) for alpha in WHOLE[1:]}
    return (
        at_most("change of W, τ and ∂τ/∂e per unit of α, α = ±1e-2 … ±1e-16", max(slopes), 10),
        at_most("bar bent with α = ±1e-6, distance from α = 0", max(far[1e-6], far[-1e-6]), 1e-5),
        below("with α = ±1e-12", max(far[1e-12], far[-1e-12]), 1e-9),
    )


WHOLE = (0.0, 1e-6, -1e-6, 1e-12, -1e-12)


def _energies(alpha: float) -> Points:
    return np.array([Ogden((1.0,), (alpha,)).energy(logs) for logs in LOGS])


def _stresses(alpha: float) -> Points:
    stresses = [Ogden((1.0,), (alpha,)).principal_stresses(logs) for logs in LOGS]
    return np.linalg.norm(stresses, axis=1)


def _stiffnesses(alpha: float) -> Points:
    return np.array([np.linalg.norm(_response(alpha, np.exp(logs))[1]) for logs in LOGS])


TURN = np.linalg.qr(np.array([[1.0, 2.0, 0.5], [-1.0, 0.3, 2.0], [0.2, 1.0, 1.0]]))[0]


def _response(alpha: float, stretches: Points) -> tuple[Points, Points]:
    """Kirchhoff stress (6,) and spatial tangent (6, 6) in axes turned against the principal."""
    gradient = TURN @ np.diag(np.expm1(np.log(stretches))) @ TURN.T
    constants = packed((1.0, 0.5), (alpha, -2.0))
    b, axes, logs = np.empty((3, 3)), np.empty((3, 3)), np.empty(3)
    stress, normal, shear = np.empty(3), np.empty((3, 3)), np.empty(3)
    tau, tangent = np.empty(6), np.empty((6, 6))
    spectrum(gradient, b, axes, logs)
    principal_response(constants.number, logs, b, 0.0, constants.values, stress, normal, shear)
    to_global_axes(axes, stress, normal, shear, tau, tangent)
    return tau, tangent


GAPS = [0.0, *(10.0**-k for k in range(15, 1, -1))]


def equal_stretches() -> tuple[Finding, ...]:
    """Stress and tangent as two or three stretches come together; a solve where they stay equal."""
    slopes = []
    for third in (1.0, 2.0 ** -(1 / 3), 0.3):  # all three equal, and two of them
        responses = [_response(3.05, np.array([1.0 + gap, 1.0, third]) * 2.0) for gap in GAPS]
        for gap, (_, tangent) in zip(GAPS, responses, strict=True):
            slopes.append(distance(tangent, responses[0][1]) / (gap + ROUNDING))
        stresses = [tau for tau, _ in responses]
        scale = float(np.abs(responses[0][1]).max())
        for (one, a), (two, b) in pairwise(zip(GAPS, stresses, strict=True)):
            slopes.append(float(np.abs(b - a).max()) / scale / (two - one + ROUNDING))
    mesh = box_mesh((2, 2, 2), distortion=0.25)
    solution = equibiaxial(2.0)
    exact = mesh.nodes * (2.0 ** np.array([1, 1, -2]) - 1)
    forces = [reaction(solution, name).force[k] for k, name in enumerate(("x1", "y1"))]
    return (
        at_most("change of τ and tangent per unit of the gap, 1e-15 … 1e-2", max(slopes), 10),
        below(
            "block drawn to (2, 2, 1/4), displacement off by",
            float(np.abs(solution.displacement - exact).max()), 1e-8, "mm",
        ),
        below("its two forces differ by", abs(forces[0] / forces[1] - 1), 1e-8),
    )  # fmt: skip


def equibiaxial(stretch: float) -> Solution:
    """A block of distorted elements drawn alike along x and y."""
    mesh = box_mesh((2, 2, 2), distortion=0.25)
    led = {"x1": stretched(stretch, 0), "y1": stretched(stretch, 1)}
    supports = Supports(symmetry=THREE_PLANES.symmetry, prescribed=led)
    return solved(Problem(mesh, NINJAFLEX, supports))


def large_exponents() -> tuple[Finding, ...]:
    """Exponents whose powers run over ten and over fifty decades."""
    gentle, far, reasons = [], [], []
    for alpha in (25.0, -25.0):
        material = Ogden((1.0,), (alpha,))
        gentle.append(_stray(_uniaxial(material, 1.3), 1.3))
        solution = _uniaxial(material, 7.6)
        far.append(_stray(solution, 1 + 6.6 * solution.load))
        reasons.append(solution.converged or len(solution.message) > 30)
    return (
        below("block at stretch 1.3, α = ±25, displacement off by", max(gentle), 1e-8, "mm"),
        true("on the way to 7.6 each arrives or gives a reason", all(reasons)),
        below("last state off by", max(far), 1e-3, "mm"),
    )


def _uniaxial(material: Ogden, stretch: float) -> Solution:
    """A block of distorted elements led to a stretch."""
    mesh = box_mesh((2, 1, 1), distortion=0.2)
    led = Supports(symmetry=THREE_PLANES.symmetry, prescribed={"x1": stretched(stretch)})
    return solve(Problem(mesh, material, led), 0.0, TIGHT)


def _stray(solution: Solution, stretch: float) -> float:
    """Distance from the homogeneous state, mm."""
    exact = solution.problem.mesh.nodes * (np.array([stretch, stretch**-0.5, stretch**-0.5]) - 1)
    return float(np.abs(solution.displacement - exact).max())


def softening() -> tuple[Finding, ...]:
    """Yeoh's material with a negative C20 under dead tension: the nominal stress has a maximum."""
    material = Ogden.yeoh(0.5, -0.02)

    def nominal(stretch: Points) -> Points:
        invariant = stretch**2 + 2 / stretch - 3
        return 2 * (stretch - stretch**-2) * (0.5 - 2 * 0.02 * invariant)

    highest = float(nominal(np.linspace(1, 4, 30001)).max())
    mesh = box_mesh((2, 1, 1))
    load = Traction("x1", (2 * highest, 0.0, 0.0))
    solution = solve(Problem(mesh, material, THREE_PLANES, loads=(load,)))
    limit = 0.0 if solution.limit is None else 2 * solution.limit
    return (
        true("twice the highest load is refused", not solution.converged, solution.message),
        within("limit found over the closed form's", limit, 0.97, 1.001),
        true("the state returned is stable", solution.stable is True and solution.load < 0.5),
    )


def compression() -> tuple[Finding, ...]:
    """Neo-Hooke squeezed flat, past the stretch where a free surface folds (Biot: 0.544)."""
    findings = []
    for name, material in (("neo-Hooke", NEO_HOOKE), ("NinjaFlex", NINJAFLEX)):
        held = Supports(symmetry=THREE_PLANES.symmetry, prescribed={"x1": stretched(-0.2)})
        solution = solve(Problem(box_mesh((2, 2, 2)), material, held))
        stretch = 1 - 1.2 * solution.load
        findings += [
            true(
                f"{name}: refused as '{_reason(solution)}'",
                not solution.converged and "stability is lost" in solution.message,
                solution.message,
            ),
            within(f"{name}: last stretch", stretch, 0.3, 0.6),
        ]
    return tuple(findings)


def _reason(solution: Solution) -> str:
    return next((said for said in ("stability is lost",) if said in solution.message), "?")


CASES = (
    HardCase(
        "Exponent α → 0 and α = 0",
        "2μ/α² grows without bound; differences cancel or divide by zero",
        "`expm1(x)/x` and its kin: no switch, no division by α; α = 0 is Hencky's material",
        vanishing_exponent,
    ),
    HardCase(
        "Equal and nearly equal stretches",
        "divided differences of the stress lose all digits, or snap to a limit and jump",
        "the differences are formed from the gap itself; equal eigenvalues need no special care",
        equal_stretches,
    ),
    HardCase(
        "Exponents of ±25",
        "a trial state overflows; stress runs over twenty decades",
        "steps are cut; what cannot be reached ends with a reason, at a state that is right",
        large_exponents,
    ),
    HardCase(
        "A material that softens (Yeoh, C20 < 0)",
        "Newton jumps over the maximum to a state that does not exist",
        "the limit point is found and named; the state returned is the last stable one",
        softening,
        inertia=True,
    ),
    HardCase(
        "A block squeezed past zero thickness",
        "elements turn inside out; a folded surface is passed off as a flat one",
        "the walk ends where the tangent shows a second negative direction",
        compression,
        inertia=True,
    ),
)
