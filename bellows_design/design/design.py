"""Design: everything that decides what is printed and whether it is approved, as one frozen value.

A design is a TOML file; the shipped ones have the same form as a user's. Every bound is checked
once, when the design is made. Errors are ``DesignError`` with one sentence per problem.
"""

from __future__ import annotations

import hashlib
import json
import re
import tomllib
from collections.abc import Mapping
from importlib.resources import files
from pathlib import Path
from typing import Any, Self

from pydantic import Field, ValidationError, field_validator, model_validator
from pydantic_core import PydanticKnownError

from bellows_design.design.bellows_parameters import BellowsParameters, Indent, Parameters, Port
from bellows_design.errors import DesignError, did_you_mean, quoted, sentences
from bellows_design.materials.library import Material, load_material, material_names

LARGEST_FILE = 1_000_000
"""Bytes. No design is longer; a larger file was named by mistake."""

ATMOSPHERE = 0.101325
"""MPa. The standard atmosphere: no vacuum pulls more."""

LEAST_PRESSURE = 0.001
"""MPa, of either sign."""

MOST_DOTS = 100
"""In a line, outside of quoted text: reading a key takes time as the square of its parts."""

_QUOTED_TEXT = re.compile(r"""\"(?:[^"\\]|\\.?)*+\"?|'[^']*+'?""")

_SLUG = re.compile(r"[A-Za-z0-9_][A-Za-z0-9_-]{0,63}")
_WINDOWS_DEVICE = re.compile(r"(con|prn|aux|nul|com\d|lpt\d)", re.IGNORECASE)
_LABELS = {"name": True, "description": True, "material": {"name", "source", "valid_strain"}}
"""Fields that name a design without changing what is built or decided."""


class Load(Parameters):
    """What the actuator must carry.

    The bounds are the full vacuum and the 6 bar of workshop air, and 10 mbar of either: wide for a
    soft actuator, yet narrow enough that 0.1 MPa given in bar, kPa or Pa falls outside.
    """

    pressure: float = Field(
        default=0.1,
        ge=-ATMOSPHERE,
        le=0.6,
        description="design pressure inside the chambers over that outside, negative for a vacuum",
        json_schema_extra={"unit": "MPa", "least": LEAST_PRESSURE},
    )

    @field_validator("pressure")
    @classmethod
    def _is_a_load(cls, pressure: float) -> float:
        if 0 <= pressure < LEAST_PRESSURE:
            raise PydanticKnownError("greater_than_equal", {"ge": LEAST_PRESSURE})
        if -LEAST_PRESSURE < pressure < 0:
            raise PydanticKnownError("less_than_equal", {"le": -LEAST_PRESSURE})
        return pressure


class Limits(Parameters):
    """What an approved design must keep, besides the printer's rules."""

    max_von_mises: float | None = Field(
        default=None,
        ge=0.01,
        le=200,
        description="highest von Mises stress; without it the material's yield strength",
        json_schema_extra={"unit": "MPa"},
    )
    cross_section_width: float = Field(
        default=20.0, ge=4, le=250, description="room along y", json_schema_extra={"unit": "mm"}
    )
    cross_section_height: float = Field(
        default=20.0, ge=4, le=250, description="room along z", json_schema_extra={"unit": "mm"}
    )


class Design(Parameters):
    """A bellows actuator and the conditions it must meet. Raises ``DesignError``."""

    name: str = Field(description="letters, digits, _ and -, at most 64; names files and folders")
    description: str = Field(default="", max_length=2000)
    bellows: BellowsParameters
    indent: Indent | None = None
    port: Port = Field(default_factory=Port)
    material: Material = Field(default_factory=lambda: load_material("ninjaflex"))
    load: Load = Field(default_factory=Load)
    printer: str = Field(default="prusa_i3", description="name of a printer profile")
    limits: Limits = Field(default_factory=Limits)

    def __init__(self, /, **data: Any) -> None:  # "self" may be a key of the file
        try:
            super().__init__(**data)
        except ValidationError as error:
            raise DesignError(*sentences(error, type(self))) from None

    @classmethod
    def of(cls, data: Mapping[str, Any]) -> Self:
        """Design of a plain table, as TOML gives it. Raises ``DesignError``."""
        try:
            return cls.model_validate(dict(data))
        except ValidationError as error:
            raise DesignError(*sentences(error, cls)) from None

    @classmethod
    def from_toml(cls, text: str) -> Self:
        """Design written as TOML. Raises ``DesignError``."""
        return cls.of(_parsed(text))

    def to_toml(self) -> str:
        """This design as TOML; a material of the library stands there by its name."""
        import tomli_w

        table = self.model_dump(mode="json", exclude_none=True)
        if self.material.name in material_names() and self.material == load_material(
            self.material.name
        ):
            table["material"] = self.material.name
        return tomli_w.dumps(table)

    @property
    def max_von_mises(self) -> float:
        """Highest allowed von Mises stress, MPa: the limit given, else the material's yield."""
        given = self.limits.max_von_mises
        return self.material.yield_strength if given is None else given

    @property
    def digest(self) -> str:
        """SHA-256 of what is built and decided, as hexadecimal digits.

        Independent of the order of keys, the spelling of numbers, and of names and descriptions.
        """
        content = self.model_dump(mode="json", exclude=_LABELS)  # type: ignore[arg-type]
        if not self.material.higher:  # a material of before Yeoh's terms keeps its digest
            del content["material"]["higher"]
        canonical = json.dumps(_without_signed_zero(content), sort_keys=True, allow_nan=False)
        return hashlib.sha256(canonical.encode("ascii")).hexdigest()

    @field_validator("name")
    @classmethod
    def _names_a_file(cls, name: str) -> str:
        if not _SLUG.fullmatch(name) or _WINDOWS_DEVICE.fullmatch(name):
            raise ValueError(
                f"name is {quoted(name)} but must be 1 to 64 letters, digits, _ or -, "
                "not begin with - and not be a device of Windows"
            )
        return name

    @field_validator("description")
    @classmethod
    def _is_printable(cls, description: str) -> str:
        if not description.isprintable():
            raise ValueError(
                f"description is {quoted(description)} but must be printable text on one line"
            )
        return description

    @field_validator("printer")
    @classmethod
    def _names_a_profile(cls, printer: str) -> str:
        if not _SLUG.fullmatch(printer):
            raise ValueError(
                f"printer is {quoted(printer)} but must be the name of a printer profile: "
                "1 to 64 letters, digits, _ or -"
            )
        return printer

    @field_validator("material", mode="before")
    @classmethod
    def _material_of_library(cls, value: Any) -> Any:
        return load_material(value) if isinstance(value, str) else value

    @model_validator(mode="after")
    def _parts_fit(self) -> Self:
        if self.indent is not None:
            self.indent.check_fits(self.bellows)
        self.port.check_fits(self.bellows)
        return self


def shipped_designs() -> tuple[str, ...]:
    """Names of the designs that come with the package."""
    folder = files("bellows_design.design") / "designs"
    names = (file.name for file in folder.iterdir() if file.name.endswith(".toml"))
    return tuple(sorted(name.removesuffix(".toml") for name in names))


def load_design(name_or_path: str | Path) -> Design:
    """The shipped design of that name, else the design in the TOML file at that path.

    Raises ``DesignError`` if there is neither, or if the file describes no design.
    """
    if isinstance(name_or_path, str) and name_or_path in shipped_designs():
        resource = files("bellows_design.design") / "designs" / f"{name_or_path}.toml"
        return Design.from_toml(resource.read_text("utf-8"))
    return Design.from_toml(_read(name_or_path))


def _read(given: str | Path) -> str:
    path = Path(given)
    try:
        if not path.is_file():
            raise DesignError(_not_found(str(given), path))
        if path.stat().st_size > LARGEST_FILE:
            raise DesignError(f"{quoted(str(given))} is larger than 1 MB and is no design.")
        return path.read_text("utf-8-sig")  # some editors put a mark first
    except UnicodeDecodeError:
        raise DesignError(f"{quoted(str(given))} is not a text file in UTF-8.") from None
    except (OSError, ValueError) as error:  # ValueError: a null byte in the path
        if isinstance(error, DesignError):
            raise
        reason = getattr(error, "strerror", None) or error
        raise DesignError(f"cannot read {quoted(str(given))}: {reason}.") from None


def _not_found(given: str, path: Path) -> str:
    if path.is_dir():
        return f"{quoted(given)} is a folder, not a design file."
    if path.suffix == ".toml" or len(path.parts) > 1:
        return f"there is no file {quoted(given)}."
    return f"unknown design {quoted(given)}{did_you_mean(given, shipped_designs())}"


def _parsed(text: str) -> dict[str, Any]:
    try:
        return parse_toml(text)
    except RecursionError:
        raise DesignError("the design is nested too deeply to be read.") from None
    except ValueError as error:  # malformed TOML, or an integer with thousands of digits
        raise DesignError(f"the design is not valid TOML: {quoted_reason(error)}.") from None


def parse_toml(text: str) -> dict[str, Any]:
    """``text`` as a table, soon. Raises ``RecursionError`` or ``ValueError``."""
    one_line_each = '"""' not in text and "'''" not in text
    for line in text.split("\n"):
        if line.count(".") > MOST_DOTS:
            bare = _QUOTED_TEXT.sub("", line) if one_line_each else line
            if bare.count(".") > MOST_DOTS:
                raise ValueError(f"a line has more than {MOST_DOTS} dots")
    return tomllib.loads(text)


def quoted_reason(error: Exception) -> str:
    """The message of an error as part of a sentence: one line, no full stop."""
    return quoted(str(error).rstrip(".")).strip("“”")


def _without_signed_zero(content: Any) -> Any:
    if isinstance(content, dict):
        return {key: _without_signed_zero(value) for key, value in content.items()}
    if isinstance(content, list):
        return [_without_signed_zero(value) for value in content]
    return content + 0.0 if isinstance(content, float) else content
