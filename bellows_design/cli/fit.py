"""``bellows fit``: from a table of measurements to a material a design can use."""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from bellows_design.cli.answer import DONE, REFUSED, Answer
from bellows_design.errors import DesignError, quoted, sentences
from bellows_design.files.atomic import replacing
from bellows_design.materials.fitting.fit_result import Fit
from bellows_design.materials.fitting.measurements import Measurements, load_measurements
from bellows_design.materials.fitting.ogden import BEST, YEOH
from bellows_design.materials.fitting.ogden import fit as fit_measurements
from bellows_design.materials.library import Material
from bellows_design.reports.fit import fit_content, fit_table


def fit(
    data: Path,
    model: str = BEST,
    output: Path | None = None,
    yield_strength: float | None = None,
    plot: Path | None = None,
) -> Answer:
    """Fit ``model`` to the measurements in ``data``; write a material and a plot if asked.

    ``yield_strength`` in MPa goes into the material, which cannot do without: it decides what is
    approved, and these tests do not tell it. Exit status 1, and no material, if the fit cannot be
    one. Raises ``DesignError`` for bad input, before anything is computed where possible.
    """
    _check(output, yield_strength, plot)
    measurements = load_measurements(data)
    choice = fit_measurements(measurements, model)
    content = fit_content(measurements, model, choice)
    material, refused = _material(measurements, choice.fit, output, yield_strength)
    if output is not None and material is not None:
        write_material(material, output)
        content["material_file"] = str(output)
    if plot is not None:
        from bellows_design.reports.fit_plot import plot_fit

        plot_fit(measurements, choice.fit, plot)
        content["plot_file"] = str(plot)
    content["refused"] = refused
    return Answer(content, fit_table(content), DONE if refused is None else REFUSED)


def write_material(material: Material, path: Path) -> None:
    """Write ``material`` as TOML, in the form of the library's; completely or not at all."""
    import tomli_w

    table = material.model_dump(mode="json", exclude_none=True)
    if not material.higher:
        del table["higher"]
    with replacing(path) as temporary:
        temporary.write_text(tomli_w.dumps(table), "utf-8")


def _material(
    data: Measurements, fit: Fit, output: Path | None, yield_strength: float | None
) -> tuple[Material | None, str | None]:
    """The fitted material, if one is wanted and the fit can be one, and why it cannot."""
    low, high = data.valid_strain
    stable = fit.stable or (fit.model == YEOH and fit.stability.covers(1 + low, 1 + high))
    if fit.vanished or not stable:
        what = "is unstable" if not stable else "has a term that adds nothing"
        return None, f"{fit.model} {what}; a design takes no such material."
    if output is None or yield_strength is None:
        return None, None
    table = {
        "name": _name(output),
        "model": YEOH if fit.model == YEOH else "ogden",
        "mu": [float(f"{value:.9g}") for value in fit.mu],
        "alpha": [float(f"{value:.9g}") for value in fit.alpha],
        "higher": [float(f"{value:.9g}") for value in fit.higher],
        "yield_strength": yield_strength,
        "valid_strain": _valid_strain(data),
        "source": _source(data, fit),
    }
    return _validated(table), None


def _valid_strain(data: Measurements) -> list[float] | None:
    """Range of the tests, rounded; None where it does not hold 0 on its inside."""
    low, high = (round(end, 4) for end in data.valid_strain)
    return [low, high] if -1 < low < 0 < high else None


def _validated(table: dict[str, Any]) -> Material:
    try:
        return Material.model_validate(table)
    except ValidationError as error:
        raise DesignError(*sentences(error, Material)) from None


def _name(output: Path) -> str:
    return re.sub(r"[^A-Za-z0-9_-]+", "_", output.stem).strip("_-")[:64] or "fitted"


def _source(data: Measurements, fit: Fit) -> str:
    low, high = data.valid_strain
    open_ones = "" if fit.determined else " NOT DETERMINED by these tests: see the intervals."
    return (
        f"fit of {fit.model} to {quoted(data.name)}: {fit.points} points, {', '.join(data.modes)}; "
        f"R² {fit.r_squared:.5f}, largest error {fit.misfit.error:.3g} MPa; principal nominal "
        f"strains from {low:.3g} to {high:.3g}; yield strength as given.{open_ones}"
    )


def _check(output: Path | None, yield_strength: float | None, plot: Path | None) -> None:
    if output is not None:
        _require_place(output, ".toml")
        if yield_strength is None:
            raise DesignError(
                "a material needs a yield strength in MPa, which these tests do not tell; "
                "give it with --yield-strength."
            )
    if yield_strength is not None and not 0.01 <= yield_strength <= 200:
        shown = f"{yield_strength:g}" if math.isfinite(yield_strength) else str(yield_strength)
        raise DesignError(f"--yield-strength is {shown} MPa but must lie between 0.01 and 200 MPa.")
    if plot is not None:
        from bellows_design.reports.benchmark_plot import require_matplotlib

        _require_place(plot, ".png")
        require_matplotlib()


def _require_place(path: Path, suffix: str) -> None:
    """Refuse a file that cannot be written or whose name does not end in ``suffix``."""
    if path.suffix.lower() != suffix:
        raise DesignError(f"{quoted(str(path))} must end in {suffix}.")
    if not path.parent.is_dir():
        raise DesignError(f"there is no folder {quoted(str(path.parent))} to write to.")
    if path.is_dir():
        raise DesignError(f"{quoted(str(path))} is a folder, not a file to write.")
