"""Printer profiles: what a machine and its nozzle can do, as TOML files.

Profiles ship in `profiles/`; other packages add their own as data files through the entry-point
group `bellows_design.printers`, whose values name packages that hold `*.toml` files.
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from importlib.metadata import entry_points
from importlib.resources import files
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import Annotated, Any, Self

from pydantic import (
    AfterValidator,
    BaseModel,
    ConfigDict,
    Field,
    ValidationError,
    model_validator,
)

ENTRY_POINT_GROUP = "bellows_design.printers"

LARGEST_FILE = 1_000_000
"""Bytes. No profile is longer; a larger file was named by mistake."""

MOST_DOTS = 100
"""In a line. The time that TOML takes to read grows with the square of a dotted key's parts."""

_LONGEST_QUOTE = 200

LONGEST_TEXT = 2000
"""Characters."""


def _printable(text: str) -> str:
    """``text``, which goes to terminals and into manifests: no control characters, one line."""
    if not text.isprintable():
        raise ValueError(f"{_quoted(text)} must be printable text on one line")
    return text


Text = Annotated[str, Field(max_length=LONGEST_TEXT), AfterValidator(_printable)]
Percent = Annotated[float, Field(ge=0, le=100)]
Celsius = Annotated[float, Field(ge=0, le=500)]
Side = Annotated[float, Field(ge=20, le=2000)]


class _Record(BaseModel):
    """Frozen, strict in its keys, refusing NaN, and raising one sentence instead of a list."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    def __init__(self, /, **data: Any) -> None:  # "self" may be a key of the file
        try:
            super().__init__(**data)
        except ValidationError as error:
            raise ValueError(_one_sentence(error, type(self))) from None


class SlicerAdvice(_Record):
    """Slicer settings that were reported together: one window, not independent limits.

    Temperatures in °C, speeds in mm/s, flows in percent of the nominal extrusion,
    `maximum_volumetric_flow` in mm³/s; `perimeters` counts the loops on each side of a wall.
    """

    nozzle_temperature: Celsius
    first_layer_temperature: Celsius
    bed_temperature: Celsius
    print_speed: float = Field(gt=0, le=500)
    maximum_volumetric_flow: float = Field(gt=0, le=100)
    perimeter_flow: float = Field(ge=50, le=200)
    infill_flow: float = Field(ge=50, le=200)
    infill_density: Percent
    infill_overlap: Percent
    fan: Percent
    perimeters: int = Field(ge=1, le=20)
    retraction: bool
    supports: bool
    seam: Text
    sources: tuple[Text, ...] = Field(min_length=1)


class PrinterProfile(_Record):
    """One printer with one nozzle, one line width and one layer height. Lengths in mm.

    - `minimum_lines`: fewest lines side by side that seal; `minimum_solid_layers`: fewest layers.
    - `build_volume`: largest part in (x, y, z).
    - `minimum_gap`: narrowest air gap that stays open; `maximum_bridge`: widest roof over air.
    - `maximum_overhang_angle`: steepest free-hanging face, degrees from the vertical.
    - `minimum_bed_contact`: part of the footprint's bounding rectangle that must lie on the bed.

    Raises ValueError with one sentence for an unknown key, NaN or a value out of bounds.
    """

    name: Text = Field(min_length=1)
    description: Text
    nozzle_diameter: float = Field(ge=0.1, le=2)
    line_width: float = Field(ge=0.08, le=3)
    layer_height: float = Field(ge=0.02, le=1.5)
    minimum_lines: int = Field(ge=1, le=20)
    minimum_solid_layers: int = Field(ge=1, le=200)
    build_volume: tuple[Side, Side, Side]
    minimum_gap: float = Field(ge=0.05, le=10)
    maximum_bridge: float = Field(ge=0.5, le=200)
    maximum_overhang_angle: float = Field(ge=10, le=90)
    minimum_bed_contact: float = Field(gt=0, le=1)
    slicer: SlicerAdvice

    @property
    def minimum_wall(self) -> float:
        """Thinnest standing wall that seals, mm."""
        return self.minimum_lines * self.line_width

    @property
    def minimum_floor(self) -> float:
        """Thinnest floor or roof that seals, mm."""
        return self.minimum_solid_layers * self.layer_height

    @property
    def thickest_wall_of_lines(self) -> float:
        """Thickest wall, mm, of perimeters alone; a thicker one has infill that fits any rest."""
        return 2 * self.slicer.perimeters * self.line_width

    @property
    def volumetric_flow(self) -> float:
        """Plastic laid down at the print speed, mm³/s."""
        section = self.line_width * self.layer_height * self.slicer.perimeter_flow / 100
        return section * self.slicer.print_speed

    @model_validator(mode="after")
    def _is_one_window(self) -> Self:
        if not 0.75 <= self.line_width / self.nozzle_diameter <= 2:
            raise ValueError(
                f"line_width is {self.line_width:g} mm; it must lie between 0.75 and 2 times "
                f"the nozzle_diameter of {self.nozzle_diameter:g} mm"
            )
        if self.layer_height > 0.8 * self.nozzle_diameter:
            raise ValueError(
                f"layer_height is {self.layer_height:g} mm; it must not exceed 0.8 times "
                f"the nozzle_diameter of {self.nozzle_diameter:g} mm"
            )
        if self.volumetric_flow > self.slicer.maximum_volumetric_flow:
            limit = self.slicer.maximum_volumetric_flow
            raise ValueError(
                f"print_speed {self.slicer.print_speed:g} mm/s asks for {self.volumetric_flow:.2f} "
                f"mm³/s, above maximum_volumetric_flow {limit:g} mm³/s"
            )
        return self


def available_profiles() -> tuple[str, ...]:
    """Names of the shipped profiles and of those other installed packages bring, sorted."""
    return tuple(sorted({*_toml_files(files("printers") / "profiles"), *_third_party()}))


def load_profile(name_or_path: str | Path) -> PrinterProfile:
    """Load a profile by its name, or from a path that ends in `.toml`.

    Raises ValueError with one sentence for an unknown name, a missing or unreadable file, an
    unknown key, NaN or a value out of bounds.
    """
    if isinstance(name_or_path, Path) or name_or_path.endswith(".toml"):
        return _read(Path(name_or_path), str(name_or_path))
    known = {**_third_party(), **_toml_files(files("printers") / "profiles")}
    if name_or_path not in known:
        raise ValueError(
            f"there is no printer profile {_quoted(name_or_path)}; "
            f"known: {', '.join(sorted(known))}"
        )
    return _read(known[name_or_path], name_or_path)


def _toml_files(folder: Traversable) -> dict[str, Traversable]:
    return {
        entry.name.removesuffix(".toml"): entry
        for entry in folder.iterdir()
        if entry.name.endswith(".toml")
    }


def _third_party() -> dict[str, Traversable]:
    found: dict[str, Traversable] = {}
    for entry_point in entry_points(group=ENTRY_POINT_GROUP):
        try:
            folder = files(entry_point.value)
        except (ImportError, TypeError) as error:
            raise ValueError(
                f"entry point {entry_point.name!r} of {ENTRY_POINT_GROUP} names "
                f"{entry_point.value!r}, which is no importable package: {error}"
            ) from None
        found.update(_toml_files(folder))
    return found


def _read(source: Traversable | Path, shown: str) -> PrinterProfile:
    name = _quoted(shown)
    try:
        table = _parsed(source)
    except FileNotFoundError:
        raise ValueError(f"there is no printer profile file {name}") from None
    except (OSError, ValueError, RecursionError) as error:
        reason = getattr(error, "strerror", None) or _cut(str(error))
        raise ValueError(f"printer profile {name} cannot be read: {reason}") from None
    try:
        return PrinterProfile(**table)
    except ValueError as error:
        raise ValueError(f"printer profile {name}: {error}") from None


def _parsed(source: Traversable | Path) -> dict[str, Any]:
    if isinstance(source, Path) and source.exists() and not source.is_dir():
        if not source.is_file():  # a pipe would keep us waiting
            raise ValueError("it is no file")
        if source.stat().st_size > LARGEST_FILE:
            raise ValueError("it is larger than 1 MB")
    text = source.read_text(encoding="utf-8-sig")  # some editors put a mark first
    if any(line.count(".") > MOST_DOTS for line in text.split("\n")):
        raise ValueError(f"it has a line with more than {MOST_DOTS} dots")
    return tomllib.loads(text)


def _quoted(value: object) -> str:
    """``value`` as it may stand in a message: on one line and not too long."""
    try:
        return _cut(repr(value))
    except (ValueError, RecursionError):  # 4300 digits, 1000 levels
        return "a huge number" if isinstance(value, int) else "too much to show"


def _cut(text: str) -> str:
    return text if len(text) <= _LONGEST_QUOTE else text[: _LONGEST_QUOTE - 1] + "…"


def _one_sentence(error: ValidationError, record: type[BaseModel]) -> str:
    first = error.errors()[0]
    key = ".".join(str(step) for step in first["loc"])
    if first["type"] == "extra_forbidden":
        return f"unknown key {_quoted(key)}; known: {', '.join(record.model_fields)}"
    if first["type"] == "missing":
        return f"key {key!r} is missing"
    text = first["msg"].removeprefix("Value error, ")
    if first["type"] == "value_error":  # a sentence of our own, complete in itself
        return f"{key}: {text}" if key else text
    given = first["input"]
    shown = f"{given:g}" if isinstance(given, float) else _quoted(given)
    return f"{key} is {shown}{_unit(key)}; {text[0].lower()}{text[1:]}"


def _unit(key: str) -> str:
    units: Mapping[str, str] = {
        "nozzle_diameter": "mm",
        "line_width": "mm",
        "layer_height": "mm",
        "build_volume": "mm",
        "minimum_gap": "mm",
        "maximum_bridge": "mm",
        "maximum_overhang_angle": "degrees",
        "nozzle_temperature": "°C",
        "first_layer_temperature": "°C",
        "bed_temperature": "°C",
        "print_speed": "mm/s",
        "maximum_volumetric_flow": "mm³/s",
        "perimeter_flow": "percent",
        "infill_flow": "percent",
        "infill_density": "percent",
        "infill_overlap": "percent",
        "fan": "percent",
    }
    named = [units[step] for step in key.split(".") if step in units]
    return f" {named[0]}" if named else ""
