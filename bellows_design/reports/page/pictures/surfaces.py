"""Surfaces on matplotlib's axes, each with its colour bar below."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from bellows_design.reports.page.blocks import Space
from bellows_design.reports.page.pictures.rendering import Look, colours_of, field_of, rendered

if TYPE_CHECKING:
    from bellows_design.web.scene import Surface


def surface_of(block: object) -> Surface | None:
    """The surface that a block of the report turns around; None if it has none."""
    from bellows_design.web.scene import Surface

    shown = block.surfaces[0] if isinstance(block, Space) else None
    return shown if isinstance(shown, Surface) else None


def draw_surface(axes: Any, surface: Surface, look: Look, title: str) -> None:
    """The surface as ``look`` says; the title names what is seen, the bar what colours mean."""
    axes.imshow(rendered(surface, look))
    axes.axis("off")
    axes.set_title(title, fontsize=9, parse_math=False)
    field = field_of(surface, look)
    if field is not None:
        bar = axes.figure.colorbar(
            _scale(surface, look), ax=axes, shrink=0.6, orientation="horizontal", pad=0.02
        )
        bar.set_label(f"{field.name}, {field.unit}", fontsize=8)
        bar.ax.tick_params(labelsize=8)


def _scale(surface: Surface, look: Look) -> Any:
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize

    options = colours_of(surface, look)
    return ScalarMappable(Normalize(*options["clim"]), options["cmap"])
