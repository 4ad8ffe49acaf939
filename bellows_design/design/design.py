"""Design: everything that decides what is printed and whether it is approved, as one frozen value.

A design is a TOML file; the shipped ones have the same form as a user's. Every bound is checked
once, when the design is made. Errors are ``DesignError`` with one sentence per problem.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, Self

from pydantic import (
    Field,
    SerializerFunctionWrapHandler,
    ValidationError,
    field_validator,
    model_serializer,
    model_validator,
)

from bellows_design.design.bellows_parameters import BellowsParameters
from bellows_design.design.conditions import Limits, Load
from bellows_design.design.digest import digest_of
from bellows_design.design.features.fingertip import Fingertip
from bellows_design.design.features.mount import Mount
from bellows_design.design.indent import Indent
from bellows_design.design.port import Port
from bellows_design.design.scenes.scene import BUILT_IN, Scene, Scenes, check_fits, scenes_of
from bellows_design.errors import DesignError
from bellows_design.files.toml_files import toml_table
from bellows_design.materials.library import load_material, material_at, material_names
from bellows_design.materials.material import Material
from bellows_design.validation.file_names import SLUG
from bellows_design.validation.labelled import Labelled
from bellows_design.validation.parameters import require
from bellows_design.validation.quoting import did_you_mean, quoted
from bellows_design.validation.sentences import sentences
from printers import PrinterProfile, PrintersError, load_profile, profile_from_table


def is_toml(name_or_path: str) -> bool:
    """Whether a material or printer is meant as a file, not by its name."""
    return name_or_path.lower().endswith(".toml")


def _profile_of(table: Mapping[str, Any]) -> PrinterProfile:
    try:
        return profile_from_table(table)
    except PrintersError as error:
        raise ValueError(f"printer: {error}") from None


class Design(Labelled):
    """A bellows actuator and the conditions it must meet, as one frozen value.

    Attributes:
        name: Letters, digits, _ and -, at most 64; names files and folders.
        description: One line of text.
        bellows: The twelve numbers, mm.
        indent: Groove under every chamber, mm; None without one.
        port: Socket for the tube, mm.
        mount: Plate with screw holes at the root, mm; None without one.
        fingertip: Pad at the tip, mm; None without one.
        material: Constants and strength, MPa; also given by the name of one of the library, or
            as a TOML file.
        load: Design pressure, MPa.
        printer: Name of a printer profile, or a profile; also given as a TOML file.
        limits: Stress in MPa and room in mm that the design must keep.
        scenes: What may stand around the actuator, by names of one's own; see ``design.scenes``.

    Raises:
        DesignError: A value leaves its bounds, or the parts do not fit together; one sentence for
            each problem.

    Examples:
        >>> from bellows_design import Design
        >>> numbers = dict(
        ...     bubble_width=20, bubble_height=20, bubble_thickness=1.2, tendon_width=6,
        ...     tendon_height=6, tendon_thickness=1.6, chamber_length=2, bubble_distance=1.2,
        ...     inner_fillet=1, outer_fillet=2.2, length=50, offset=5,
        ... )  # mm
        >>> design = Design(name="mine", bellows=numbers, load={"pressure": 0.08})
        >>> print(design.max_von_mises, "MPa allowed;", design.digest[:8])
        4.0 MPa allowed; fb49b143
        >>> print(Design.from_toml(design.to_toml()) == design)
        True
    """

    bellows: BellowsParameters
    indent: Indent | None = None
    port: Port = Field(default_factory=Port)
    mount: Mount | None = None
    fingertip: Fingertip | None = None
    material: Material = Field(
        default_factory=lambda: load_material("ninjaflex"),
        description="name of a material of the library, a TOML file, or a table",
    )
    load: Load = Field(default_factory=Load)
    printer: str | PrinterProfile = Field(
        default="prusa_i3", description="name of a printer profile, a TOML file, or a table"
    )
    limits: Limits = Field(default_factory=Limits)
    scenes: dict[str, Scene] = Field(
        default_factory=Scenes,
        description="what stands around the actuator where it exerts forces",
        examples=[{"desk": {"kind": "blocked", "support": "wall", "distance": 8.0}}],
    )

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
        return cls.of(toml_table(text, "the design"))

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
    def finger_length(self) -> float:
        """x of the finger's end, mm: the fingertip's if it has one, else the tendon's."""
        return self.bellows.length + (0.0 if self.fingertip is None else self.fingertip.length)

    def __hash__(self) -> int:
        return hash((self.name, self.digest))  # a table of scenes has no hash of its own

    @property
    def max_von_mises(self) -> float:
        """Highest allowed von Mises stress, MPa: the limit given, else the material's yield."""
        given = self.limits.max_von_mises
        return self.material.yield_strength if given is None else given

    def profile(self) -> PrinterProfile:
        """The printer's profile. Raises ``PrintersError`` if there is none of that name."""
        return load_profile(self.printer) if isinstance(self.printer, str) else self.printer

    @property
    def digest(self) -> str:
        """SHA-256 of what is built and decided, as 64 hexadecimal digits.

        Independent of the order of keys, the spelling of numbers, names and descriptions, and of
        scenes that ``limits.scenes`` does not name.
        """
        required = {name: self.scenes[name] for name in self.limits.scenes if name in self.scenes}
        return digest_of(self.model_copy(update={"scenes": required}))

    @property
    def as_evaluated(self) -> Self:
        """The design with defaults for all that no evaluation of its bending reads.

        That is what judges or makes the part, and what stands around it. The mount is left out, as
        a model begins at the root's face.
        """
        unread = ("mount", "printer", "limits", "scenes")
        fields = type(self).model_fields
        defaults = {name: fields[name].get_default(call_default_factory=True) for name in unread}
        return self.model_copy(update=defaults)

    @field_validator("printer", mode="before")
    @classmethod
    def _names_a_profile(cls, printer: Any) -> str | PrinterProfile:
        if isinstance(printer, PrinterProfile):
            return printer
        if isinstance(printer, Mapping):
            return _profile_of(printer)
        require(
            isinstance(printer, str) and (is_toml(printer) or bool(SLUG.fullmatch(printer))),
            f"printer is {quoted(printer)} but must be the name of a printer profile (1 to 64 "
            "letters, digits, _ or -), a file that ends in .toml, or a table",
        )
        return load_profile(Path(printer)) if is_toml(printer) else printer

    @field_validator("scenes", mode="before")
    @classmethod
    def _scenes_of_tables(cls, value: Any) -> dict[str, Scene]:
        return scenes_of(value)

    @field_validator("scenes", mode="after")
    @classmethod
    def _scenes_stay(cls, value: dict[str, Scene]) -> Scenes:
        return Scenes(value)

    @field_validator("material", mode="before")
    @classmethod
    def _material_of_library(cls, value: Any) -> Any:
        if not isinstance(value, str):
            return value
        return material_at(Path(value)) if is_toml(value) else load_material(value)

    @model_validator(mode="after")
    def _parts_fit(self) -> Self:
        if self.indent is not None:
            self.indent.check_fits(self.bellows)
        self.port.check_fits(self.bellows)
        if self.mount is not None:
            self.mount.check_fits(self.bellows, self.port)
        if self.fingertip is not None:
            self.fingertip.check_fits(self.bellows)
        return self

    @model_validator(mode="after")
    def _scenes_are_known(self) -> Self:
        for name, scene in self.scenes.items():
            check_fits(scene, f"scenes.{name}", self.finger_length)
        known = {**BUILT_IN, **self.scenes}
        for name in self.limits.scenes:
            require(
                name in known,
                f"limits.scenes names an unknown scene {quoted(name)}"
                f"{did_you_mean(name, sorted(known))}",
            )
        return self

    @model_serializer(mode="wrap")
    def _without_empty_scenes(self, handler: SerializerFunctionWrapHandler) -> dict[str, Any]:
        """A design without scenes is written as it was before there were any."""
        table: dict[str, Any] = handler(self)
        return {key: value for key, value in table.items() if key != "scenes" or value}
