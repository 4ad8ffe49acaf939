"""Which faces of the parts carry which name: by CadQuery's selectors, by boxes, by shells."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from pydantic import Field, field_validator

from bellows_design.errors import DesignError
from bellows_design.own_body.record import BodyRecord, Vector
from bellows_design.validation.parameters import require
from bellows_design.validation.quoting import did_you_mean, quoted

if TYPE_CHECKING:
    import cadquery as cq

    from bellows_design.own_body.parts import BodyPart

OUTSIDE = "outside"
"""Faces that nothing chooses."""

BETWEEN = "|"
"""Stands between the names of two parts in the name of the surface that they share."""

LONGEST_SELECTOR = 200
"""Characters."""


class Selection(BodyRecord):
    """Faces that fulfil all of these conditions.

    Attributes:
        select: A selector of CadQuery's grammar, such as ">X" or "|Z and (not <Z)".
        box: Two opposite corners, mm; the centres of faces lie inside or on it.
        inner: True for the faces of holes that are closed all around.
        part: Only faces of the part of that name.
    """

    select: str | None = Field(default=None, max_length=LONGEST_SELECTOR)
    box: tuple[Vector, Vector] | None = None
    inner: bool = False
    part: str | None = None

    @field_validator("select")
    @classmethod
    def _is_in_the_grammar(cls, select: str | None) -> str | None:
        if select is not None:
            _selector(select)
        return select


def selections_of(value: Any) -> Any:
    """What a file says of a surface: a selector, a table, or a list of these, as a tuple."""
    given = value if isinstance(value, list | tuple) else (value,)
    for each in given:
        require(
            isinstance(each, str | Mapping | Selection),
            f"a surface is {quoted(each)} but must be a selector, a table or a list of these",
        )
    return tuple({"select": each} if isinstance(each, str) else each for each in given)


@dataclass(frozen=True)
class PartFace:
    """A face, the number of its part, and whether a closed hole is behind it."""

    face: cq.Face
    part: int
    inner: bool


def face_names(
    parts: Sequence[BodyPart], surfaces: Mapping[str, tuple[Selection, ...]]
) -> tuple[tuple[str, ...], ...]:
    """The name of each face of each part, in the parts' own order of faces.

    Raises:
        DesignError: A surface has no faces, or two surfaces choose the same one.
    """
    faces = [face for number, part in enumerate(parts) for face in _faces_of(number, part)]
    names = [OUTSIDE] * len(faces)
    for name, selections in surfaces.items():
        chosen = {place for each in selections for place in _chosen(name, each, faces, parts)}
        if not chosen:
            raise DesignError(f"surfaces.{name} chooses no face of the body.")
        for place in sorted(chosen):
            _require_free(names[place], name, faces[place].face)
            names[place] = name
    return tuple(
        tuple(name for name, face in zip(names, faces, strict=True) if face.part == number)
        for number in range(len(parts))
    )


def _require_free(taken: str, name: str, face: cq.Face) -> None:
    if taken != OUTSIDE:
        place = ", ".join(f"{x:g}" for x in (round(c, 3) for c in face.Center().toTuple()))
        raise DesignError(
            f"surfaces.{taken} and surfaces.{name} both choose the face at ({place}) mm; "
            "a face has one name."
        )


def _faces_of(number: int, part: BodyPart) -> list[PartFace]:
    solid = part.solid
    outer = {face.hashCode() for face in solid.outerShell().Faces()}
    return [PartFace(face, number, face.hashCode() not in outer) for face in solid.Faces()]


def _chosen(
    name: str, selection: Selection, faces: Sequence[PartFace], parts: Sequence[BodyPart]
) -> list[int]:
    """Places of the faces that fulfil all conditions; the selector is asked last."""
    known = [part.name for part in parts]
    if selection.part is not None and selection.part not in known:
        raise DesignError(
            f"surfaces.{name} names an unknown part {quoted(selection.part)}"
            f"{did_you_mean(selection.part, known)}"
        )
    left = [
        place
        for place, each in enumerate(faces)
        if (selection.part is None or known[each.part] == selection.part)
        and (each.inner or not selection.inner)
        and (selection.box is None or _within(selection.box, each.face))
    ]
    if selection.select is None:
        return left
    try:
        found = _selector(selection.select).filter([faces[place].face for place in left])
    except (IndexError, ValueError):  # such as <X[9] of three
        raise DesignError(
            f"surfaces.{name}: {quoted(selection.select)} chooses no face of the {len(left)} that "
            "there are."
        ) from None
    return [place for place in left if any(faces[place].face is each for each in found)]


def _within(box: tuple[Vector, Vector], face: cq.Face) -> bool:
    """Whether a face's centre lies inside or on the box of two corners."""
    centre = face.Center().toTuple()
    return all(
        min(one, other) - 1e-6 <= x <= max(one, other) + 1e-6
        for one, other, x in zip(*box, centre, strict=True)
    )


def _selector(text: str) -> Any:
    """CadQuery's selector; ``ValueError`` for a text that its grammar does not have."""
    from cadquery import selectors
    from pyparsing import ParseException

    grammar: Any = selectors  # it carries no types
    try:
        return grammar.StringSyntaxSelector(text)
    except (ParseException, RecursionError, ValueError, KeyError):
        raise ValueError(
            f"{quoted(text)} is no selector of CadQuery's, such as >X, |Z or >X and (not >Z)"
        ) from None


def require_surface(where: str, name: str, known: Sequence[str]) -> None:
    """Raise ``ValueError`` unless a surface of that name is among the known ones."""
    require(
        name in known, f"{where} names an unknown surface {quoted(name)}{did_you_mean(name, known)}"
    )
