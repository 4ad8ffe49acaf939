"""What is tried in a process of its own, as a broken library may end the one that loads it.

``python -m bellows_design.cli.doctor.probes NAME`` prints one JSON object a line on stdout.
"""

from __future__ import annotations

import json
import os
import sys
import time
from collections.abc import Callable, Iterator, Mapping
from importlib import import_module
from typing import Any

LIGHT = (
    "numpy", "scipy.sparse", "pydantic", "rich", "typer", "psutil", "platformdirs", "rtree",
    "trimesh", "manifold3d", "lib3mf", "meshio",
)  # fmt: skip
"""Modules of the core that load fast; others have a probe of their own."""

SIDE = 16
"""Unknowns along each edge of the cube whose system is solved for a trial."""

Said = dict[str, Any]


def libraries() -> Iterator[Said]:
    """Every light module of the core, one after the other."""
    for name in LIGHT:
        yield {"begins": name}
        yield {"module": name, **_imported(name)}


def cad() -> Iterator[Said]:
    """CadQuery makes a solid."""
    yield {"begins": "cadquery"}
    import cadquery

    volume = cadquery.Solid.makeBox(1, 2, 3).Volume()
    yield {"module": "cadquery", "works": abs(volume - 6) < 1e-9}


def mesher() -> Iterator[Said]:
    """Gmsh starts in its process, as it does for a mesh, and says its version."""
    yield {"begins": "gmsh"}
    import gmsh

    gmsh.initialize(interruptible=False)
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.model.occ.addBox(0, 0, 0, 1, 1, 1)
    gmsh.model.occ.synchronize()
    gmsh.model.mesh.generate(3)
    count = len(gmsh.model.mesh.getNodes()[0])
    gmsh.finalize()
    yield {"module": "gmsh", "works": count > 8}


def solver() -> Iterator[Said]:
    """The linear solver that ``auto`` is, and how long it takes for a small system."""
    yield {"begins": "linear solver"}
    import numpy as np
    from scipy.sparse import csr_array, triu

    from solver.linear.solvers import linear_solver
    from solver.linear.sparsity import Pattern

    whole, right = _laplacian(SIDE), np.ones(SIDE**3)
    upper = csr_array(triu(whole))
    upper.sort_indices()
    chosen = linear_solver()
    began = time.perf_counter()
    chosen.analyze(Pattern(upper.indptr.astype(np.int32), upper.indices.astype(np.int32)))
    chosen.factorize(upper.data)
    found = chosen.solve(right)
    seconds = time.perf_counter() - began
    residual = float(np.abs(whole @ found - right).max())
    yield {
        "module": "linear solver",
        "works": residual < 1e-8,
        "solver": chosen.name,
        "unknowns": SIDE**3,
        "seconds": seconds,
    }


def _laplacian(side: int) -> Any:
    """Seven-point differences on a cube of so many points along each edge."""
    from scipy.sparse import csr_array, diags, identity, kron

    line = diags([-1.0, 2.0, -1.0], [-1, 0, 1], shape=(side, side))
    one = identity(side)
    cube = kron(kron(line, one), one) + kron(kron(one, line), one) + kron(kron(one, one), line)
    return csr_array(cube)


def compiler() -> Iterator[Said]:
    """Numba compiles a function; where its cache is, and whether that can be written."""
    yield {"begins": "numba"}
    import numba

    from solver.numerics.compiled import cache_folder

    settings: Any = numba.config
    folder = cache_folder(settings.CACHE_DIR)
    compiled = numba.njit(lambda x: x + 1)
    yield {
        "module": "numba",
        "works": compiled(1) == 2,
        "folder": folder,
        "writable": bool(folder) and os.access(folder, os.W_OK),
        "threads": settings.NUMBA_NUM_THREADS,
        "layer": settings.THREADING_LAYER,
    }


def display() -> Iterator[Said]:
    """VTK draws a picture where there is no screen, as pictures of parts need it."""
    yield {"begins": "pyvista"}
    import pyvista

    plotter = pyvista.Plotter(off_screen=True, window_size=[40, 40])
    plotter.add_mesh(pyvista.Sphere(theta_resolution=6, phi_resolution=6))
    picture = plotter.screenshot(return_img=True)
    plotter.close()
    yield {"module": "pyvista", "works": picture is not None and bool(picture.std() > 0)}


PROBES: Mapping[str, Callable[[], Iterator[Said]]] = {
    "libraries": libraries,
    "cad": cad,
    "mesher": mesher,
    "solver": solver,
    "compiler": compiler,
    "display": display,
}


def _imported(name: str) -> Said:
    try:
        import_module(name)
    except Exception as error:  # a broken library raises anything
        return {"works": False, "error": f"{type(error).__name__}: {error}"}
    return {"works": True}


def _main(name: str) -> None:
    answers = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)  # libraries in C print what they please
    begun = name
    try:
        for said in PROBES[name]():
            begun = said.get("begins", begun)
            print(json.dumps(said), file=answers, flush=True)
    except Exception as error:
        failure = {"module": begun, "works": False, "error": f"{type(error).__name__}: {error}"}
        print(json.dumps(failure), file=answers, flush=True)
    answers.flush()
    os._exit(0)  # not by taking libraries apart


if __name__ == "__main__":
    _main(sys.argv[1])
