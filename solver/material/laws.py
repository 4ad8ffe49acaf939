"""The table of hyperelastic laws. A new law is a module beside this one, and a row here.

The module of a law holds

- ``energy(e, constants)``: W in MPa at isochoric principal log stretches e (3,), compiled;
- ``response(e, gaps, constants, stress, hessian, divided)``: derivatives of W, compiled. It fills
  ``stress`` (3,) with s_i = dW/de_i, ``hessian`` (3, 3) with d2W/de_i de_j, and ``divided`` (3,)
  with (s_i - s_j) / (e_i - e_j) of the pairs (0, 1), (1, 2), (2, 0), whose differences e_i - e_j
  are ``gaps`` (3,): exact where stretches are equal. Only their deviatoric parts count: each s_i
  may have the same number added, and dW/de_i may be that of any extension of W to e that do not
  sum to 0;
- ``MATERIAL``: the class of its materials, a ``Hyperelastic``, made of the law's constants.

This file itself imports no compiled code.
"""

from __future__ import annotations

from importlib import import_module
from types import ModuleType
from typing import NamedTuple


class Law(NamedTuple):
    """A row of the table: the law's ``name`` in files, and the ``module`` that implements it.

    ``constants``: their names in files. The energy is linear in them, in MPa; they may be of either
    sign. Ogden's, of any number and not linear, have no such names.
    """

    name: str
    module: str
    constants: tuple[str, ...] = ()

    @property
    def implementation(self) -> ModuleType:
        """The module, imported when first asked for."""
        return import_module(f"solver.material.{self.module}")


LAWS = (
    Law("ogden", "ogden"),
    Law("mooney-rivlin-5", "mooney_rivlin", ("c10", "c01", "c20", "c11", "c02")),
)


def law(name: str) -> Law:
    """The law with that name. Raises ``KeyError`` without one."""
    return LAWS[number_of(name)]


def number_of(name: str) -> int:
    """Place of a law in the table. Raises ``KeyError`` without one of that name."""
    numbers = {row.name: number for number, row in enumerate(LAWS)}
    return numbers[name]
