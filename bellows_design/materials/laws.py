"""The material laws: what they are called, how they are written, and how they are fitted.

For materials, fits and the help of the command. The rows here are cases of the solver's Ogden law
with Yeoh's higher terms, hence have the constants μ, α and ``higher``; see ``material.py``. All
other laws come from the solver's table, ``solver.material.laws``, as they stand there.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from bellows_design.materials.fitting.fit_model import FitModel
from solver.material import laws as solver_laws

if TYPE_CHECKING:
    from bellows_design.materials.fitting.fit_result import Fit
    from bellows_design.materials.fitting.weighted import Weighted
    from bellows_design.materials.measurements.points import Measurements


class Law(NamedTuple):
    """A material law.

    Attributes:
        name: As a material's ``model`` names it.
        exponents: Its α; empty where each material has its own.
        written: The sets of constants it may be written with instead of μ, α and ``higher``. The
            first of them, as many as there are exponents, are half of a μ, the rest ``higher``.
        fits: Forms whose fits give a material of this law.
        softens: True if constants may be negative: such a material need only be stable over the
            range of its tests.
        constants: Names of its own constants where it is no case of Ogden's law.
    """

    name: str
    exponents: tuple[float, ...] = ()
    written: tuple[tuple[str, ...], ...] = ()
    fits: tuple[FitModel, ...] = ()
    softens: bool = False
    constants: tuple[str, ...] = ()


def _ogden(data: Measurements, problem: Weighted, model: FitModel) -> Fit:
    from bellows_design.materials.fitting.ogden import fit_ogden

    return fit_ogden(data, problem, model)


def _yeoh(data: Measurements, problem: Weighted, model: FitModel) -> Fit:
    from bellows_design.materials.fitting.yeoh import fit_yeoh

    return fit_yeoh(data, problem, model)


def _linear(data: Measurements, problem: Weighted, model: FitModel) -> Fit:
    from bellows_design.materials.fitting.linear import fit_law

    return fit_law(data, problem, model)


def _of_solver(law: solver_laws.Law) -> Law:
    """The row of a law of the solver's whose energy is linear in its constants."""
    form = FitModel(law.name, (), _linear, higher=len(law.constants))
    return Law(law.name, (), (law.constants,), (form,), softens=True, constants=law.constants)


_ROWS = (
    Law(
        "ogden",
        fits=(
            FitModel("neo-hooke", (2.0,), _ogden),
            FitModel("ogden1", (None,), _ogden),
            FitModel("mooney-rivlin", (2.0, -2.0), _ogden),
            FitModel("ogden2", (None, None), _ogden),
            FitModel("ogden3", (None, None, None), _ogden),
        ),
    ),
    Law("neo-hooke", (2.0,), (("c10",),)),
    Law("mooney-rivlin", (2.0, -2.0), (("c10", "c01"),)),
    Law(
        "yeoh",
        (2.0,),
        (("c10", "c20"), ("c10", "c20", "c30")),
        (FitModel("yeoh", (2.0,), _yeoh, higher=2),),
        softens=True,
    ),
    *(_of_solver(law) for law in solver_laws.LAWS if law.constants),
)

LAWS = {law.name: law for law in _ROWS}
"""Name -> law."""

FIT_MODELS = {model.name: model for law in _ROWS for model in law.fits}
"""Name -> what may be fitted."""

BEST = "best"
FIT_CHOICES = (BEST, *FIT_MODELS)
"""What may be asked of a fit; ``best`` is one of the automatic models."""

OWN_CONSTANTS = tuple(dict.fromkeys(key for law in _ROWS for form in law.written for key in form))
"""All constants a law may be written with."""


def law_of_fit(model: str) -> Law:
    """The law of the material that a fit of ``model`` gives."""
    return next(law for law in _ROWS if FIT_MODELS[model] in law.fits)
