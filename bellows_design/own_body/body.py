"""An own body: parts, the names of their faces, supports, loads and what is read, as one value."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator, Mapping
from functools import cached_property
from typing import Any, Self

from pydantic import Field, field_validator, model_validator

from bellows_design.errors import DesignError
from bellows_design.own_body.conditions import (
    BodyLoad,
    BodyMesh,
    BodySupports,
    Film,
    Gravity,
    Obstacle,
    Tip,
)
from bellows_design.own_body.parts import BodyPart
from bellows_design.own_body.record import BodyRecord, Names
from bellows_design.own_body.selection import (
    BETWEEN,
    OUTSIDE,
    Selection,
    face_names,
    require_surface,
    selections_of,
)
from bellows_design.own_body.symmetry import require_planes
from bellows_design.validation.labelled import Labelled
from bellows_design.validation.parameters import require
from bellows_design.validation.quoting import quoted

TIP, CAVITY = "tip", "cavity"
"""Surfaces with a meaning: whose rotation is the bending angle, and what is under pressure."""


MOST_PARTS = 50


class OwnBody(BodyRecord, Labelled):
    """A body of one's own with all that decides how it deforms, as one frozen value.

    Attributes:
        name: Letters, digits, _ and -, at most 64.
        description: One line of text.
        parts: Solids that touch, or one.
        surfaces: Name -> which faces carry it; faces that nothing chooses are ``outside``.
        supports: What is held.
        pressurised: Surfaces under pressure; ``cavity``, if there is one, unless others are named.
        load: Pressure, MPa, or volume.
        films: Films glued to surfaces.
        gravity: Weight, if it acts.
        obstacles: Rigid planes.
        tip: What is read at the tip.
        mesh: Sizes, mm.

    Raises:
        DesignError: A value leaves its bounds, or a surface is unknown or has no face; one sentence
            for each problem.

    Examples:
        >>> import cadquery as cq
        >>> from bellows_design import OwnBody
        >>> hollow = cq.Solid.makeBox(30, 3, 4, cq.Vector(5, 1, 4))
        >>> bar = cq.Solid.makeBox(40, 5, 10).cut(hollow)
        >>> body = OwnBody(
        ...     name="bar",
        ...     parts=[{"name": "bar", "solid": bar, "material": "ecoflex_00_30"}],
        ...     surfaces={"root": "<X", "tip": ">X", "cavity": {"inner": True}},
        ...     load={"pressure": 0.002},  # MPa
        ... )
        >>> print(body.under_pressure, len(body.face_names[0]), "faces")
        ('cavity',) 12 faces
    """

    parts: tuple[BodyPart, ...]
    surfaces: dict[str, tuple[Selection, ...]] = Field(default_factory=dict)
    supports: BodySupports = Field(default_factory=BodySupports)
    pressurised: Names | None = None
    load: BodyLoad = Field(default_factory=BodyLoad)
    films: tuple[Film, ...] = ()
    gravity: Gravity | None = None
    obstacles: tuple[Obstacle, ...] = ()
    tip: Tip = Field(default_factory=Tip)
    mesh: BodyMesh = Field(default_factory=BodyMesh)

    @classmethod
    def of(cls, data: Mapping[str, Any]) -> Self:
        """Body of a plain table, with the solids in it. Raises ``DesignError``."""
        return cls(**data)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, OwnBody):
            return NotImplemented
        texts = (self.name, self.description) == (other.name, other.description)
        return texts and self.digest == other.digest

    def __hash__(self) -> int:
        return hash((self.name, self.digest))

    @property
    def under_pressure(self) -> tuple[str, ...]:
        """Names of the surfaces under pressure."""
        if self.pressurised is not None:
            return self.pressurised
        return (CAVITY,) if CAVITY in self.surfaces else ()

    @cached_property
    def face_names(self) -> tuple[tuple[str, ...], ...]:
        """The name of each face of each part."""
        return face_names(self.parts, self.surfaces)

    def at_pressure(self, pressure: float) -> Self:
        """The same under another pressure, MPa. Raises ``DesignError`` where a volume is given."""
        if self.load.by_volume:
            raise DesignError(
                f"pressure = {pressure:g} MPa cannot be asked for where load.largest_volume is "
                "given: the pressure is a result."
            )
        fields = {name: getattr(self, name) for name in type(self).model_fields}
        return type(self)(**fields | {"load": {"pressure": pressure}})

    @property
    def table(self) -> dict[str, Any]:
        """All but the solids and what is as by default, as JSON and TOML have it."""
        return self.model_dump(mode="json", exclude_defaults=True)

    @property
    def digest(self) -> str:
        """SHA-256 of all that decides how it deforms, the solids too, as 64 hexadecimal digits."""
        labels = ("name", "description")
        content = {key: value for key, value in self.table.items() if key not in labels}
        shapes = [part.shape_digest for part in self.parts]
        text = json.dumps([content, shapes], sort_keys=True, allow_nan=False)
        return hashlib.sha256(text.encode("ascii")).hexdigest()

    @field_validator("surfaces", mode="before")
    @classmethod
    def _surfaces_of_text(cls, value: Any) -> Any:
        if not isinstance(value, Mapping):
            return value
        return {name: selections_of(each) for name, each in value.items()}

    @model_validator(mode="after")
    def _names_are_known(self) -> Self:
        for name in self.surfaces:
            require(
                name.isprintable() and BETWEEN not in name and name not in ("", OUTSIDE),
                f"a surface is called {quoted(name)} but must have a printable name without "
                f"{BETWEEN}, other than {OUTSIDE}",
            )
        parts = [part.name for part in self.parts]
        require(0 < len(parts) <= MOST_PARTS, f"parts must be 1 to {MOST_PARTS}, not {len(parts)}")
        require(len(set(parts)) == len(parts), "two parts have the same name")
        outer = (*self.surfaces, OUTSIDE)
        between = tuple(
            BETWEEN.join((one, other)) for k, one in enumerate(parts) for other in parts[k + 1 :]
        )
        for where, name in self._named():
            require_surface(where, name, outer)
        for film in self.films:
            require_surface("films.surface", film.surface, (*outer, *between))
        return self

    @model_validator(mode="after")
    def _is_complete(self) -> Self:
        pressed = self.load.by_volume or self.load.pressure
        require(
            not pressed or bool(self.under_pressure),
            "load presses on nothing: name a surface cavity, or others as pressurised",
        )
        require(
            bool(pressed) or self.gravity is not None,
            "nothing acts on the body: give load.pressure, load.largest_volume or gravity",
        )
        bare = [part.name for part in self.parts if part.density_kg_m3 is None]
        require(
            self.gravity is None or not bare,
            f"gravity needs the density_kg_m3 of every part; {quoted(''.join(bare[:1]))} has none",
        )
        return self

    @model_validator(mode="after")
    def _faces_have_names(self) -> Self:
        require_planes(self.supports.symmetry, self.parts, self.face_names)
        return self

    def _named(self) -> Iterator[tuple[str, str]]:
        """Where surfaces are named, and their names."""
        yield from (("supports.clamped", name) for name in self.supports.clamped)
        yield from (("supports.symmetry", name) for name in self.supports.symmetry)
        yield from (("pressurised", name) for name in self.pressurised or ())
        yield from (("obstacles.surface", each.surface) for each in self.obstacles)
