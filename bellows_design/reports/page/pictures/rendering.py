"""Surfaces as pixels, drawn by PyVista without a screen."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from bellows_design.errors import DesignError
from bellows_design.web.scene import Field, Surface, frames_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

COLOURS = "viridis"


@dataclass(frozen=True)
class Look:
    """How a surface is drawn: which field and frame, cut open along y or not, px."""

    field: str = ""
    frame: int = -1
    cut: bool = False
    size: tuple[int, int] = (900, 620)


def rendered(surface: Surface, look: Look) -> NDArray[np.uint8]:
    """Pixels (height, width, 3) of the surface.

    Raises ``DesignError`` where nothing can be drawn: a machine without any way to do so.
    """
    import pyvista

    _leave_streams_alone()
    try:
        plotter: Any = pyvista.Plotter(off_screen=True, window_size=list(look.size))
        plotter.set_background("white")
        mesh = _mesh(surface, look)
        plotter.add_mesh(mesh, **_options(surface, look))
        plotter.view_vector((-0.55, -1.0, 0.45) if not look.cut else (0.0, -1.0, 0.18))
        plotter.camera.zoom(_closest(plotter.camera, mesh.points, look.size))
        plotter.enable_anti_aliasing("ssaa")
        pixels = plotter.screenshot(return_img=True)
        plotter.close()
    except Exception as error:  # VTK has no class of its own for this
        raise DesignError(f"PyVista cannot draw on this machine: {error}.") from error
    return np.asarray(pixels)


FILLED = 0.95
"""Of the picture, by what is shown in it."""


def _closest(camera: Any, points: NDArray[np.floating[Any]], size: tuple[int, int]) -> float:
    """The zoom at which ``points`` (n, 3) fill the picture of ``size`` and none is cut off."""
    ahead = np.subtract(camera.focal_point, camera.position)
    right = np.cross(ahead, camera.up)
    up = np.cross(right, ahead)
    from_eye = points - np.array(camera.position)
    depth, *across = (from_eye @ (each / np.linalg.norm(each)) for each in (ahead, right, up))
    wide, high = (float(np.abs(each / depth).max()) for each in across)
    seen = np.radians(camera.view_angle) / 2
    return float(FILLED * seen / np.arctan(max(high, wide * size[1] / size[0])))


def _leave_streams_alone() -> None:
    """Without a screen VTK warns of it, and then draws without one; what fails is raised anyway."""
    from vtkmodules.vtkCommonCore import vtkLogger

    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)


def _mesh(surface: Surface, look: Look) -> Any:
    import pyvista

    positions = frames_of(surface)[look.frame]
    triangles: Any = np.asarray(surface.triangles)
    mesh: Any = pyvista.PolyData.from_regular_faces(positions, triangles)
    field = field_of(surface, look)
    if field is not None:
        values = np.asarray(field.values)
        mesh[field.name] = values if values.ndim == 1 else values[look.frame]
    return mesh.clip((0, 1, 0), origin=(0, 0, 0), invert=False) if look.cut else mesh


def _options(surface: Surface, look: Look) -> dict[str, Any]:
    """Colours of a field, hardly darker in the shade than on their bar, or one colour."""
    field = field_of(surface, look)
    smooth = {"smooth_shading": True, "split_sharp_edges": True, "show_scalar_bar": False}
    if field is None:
        return smooth | {"color": "#86aed2"}
    light = {"ambient": 0.45, "diffuse": 0.6}
    return smooth | light | {"scalars": field.name, "nan_color": "grey"} | colours_of(surface, look)


def colours_of(surface: Surface, look: Look) -> dict[str, Any]:
    """Name of the colour map and ends of the field's scale, as PyVista calls them."""
    field = field_of(surface, look)
    assert field is not None
    name = f"{COLOURS}_r" if field.reverse else COLOURS
    return {"cmap": name, "clim": scale_of(field)}


def field_of(surface: Surface, look: Look) -> Field | None:
    """The field that colours the surface."""
    return next((each for each in surface.fields if each.name == look.field), None)


def scale_of(field: Field) -> tuple[float, float]:
    """Ends of its colours."""
    values = np.asarray(field.values)
    low = float(np.nanmin(values)) if field.low is None else field.low
    high = float(np.nanmax(values)) if field.high is None else field.high
    return low, high
