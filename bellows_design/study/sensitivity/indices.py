"""Global sensitivity: which share of a response's variance comes from which parameter.

First and total indices after I. M. Sobol' (Math. Comput. Simul. 55, 2001) and A. Saltelli et al.
(Comput. Phys. Commun. 181, 2010), as SALib computes them.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from importlib.util import find_spec

import numpy as np

from bellows_design.errors import DesignError
from solver.arrays import Reals

BASE_SAMPLES = 4096
"""Each costs two evaluations more than there are parameters, of a surrogate."""

CONFIDENCE = 0.95


@dataclass(frozen=True)
class Index:
    """Shares of the variance due to a parameter, with half widths of their 95 % intervals.

    ``first`` is due to it alone, ``total`` to it together with others too.
    """

    parameter: str
    first: float
    first_confidence: float
    total: float
    total_confidence: float


def require_salib() -> None:
    """Raise ``DesignError`` if it is not installed. Imports nothing."""
    if find_spec("SALib") is None:
        raise DesignError(
            "Sobol indices need SALib, which comes with the extra “studies”: "
            "pip install -e '.[studies]'; --no-sobol leaves them out."
        )


def sobol_indices(
    response: Callable[[Reals], Reals],
    names: Sequence[str],
    seed: int,
    base_samples: int = BASE_SAMPLES,
) -> tuple[Index, ...]:
    """Indices of a response over the box from -1 to 1 in every parameter, the largest total first.

    Args:
        response: Values, (points,), at points, (points, parameters).
        names: Of the parameters.
        seed: The same seed gives the same indices.
        base_samples: A power of two.

    Raises ``DesignError`` without SALib.
    """
    require_salib()
    from SALib.analyze import sobol as analysis
    from SALib.sample import sobol as sampling

    problem = {"num_vars": len(names), "names": list(names), "bounds": [[-1, 1]] * len(names)}
    points = sampling.sample(problem, base_samples, calc_second_order=False, seed=seed)
    values = response(np.asarray(points))
    found = analysis.analyze(  # it would take a seed of 0 for none
        problem, values, calc_second_order=False, conf_level=CONFIDENCE, seed=seed + 1
    )
    columns = (found[key].tolist() for key in ("S1", "S1_conf", "ST", "ST_conf"))
    rows = (Index(*row) for row in zip(names, *columns, strict=True))
    return tuple(sorted(rows, key=lambda row: row.total, reverse=True))
