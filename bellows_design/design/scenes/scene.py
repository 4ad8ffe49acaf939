"""Scenes by their kinds and names, of tables and files."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from bellows_design.design.scenes.blocked import Blocked
from bellows_design.design.scenes.free import Free
from bellows_design.design.scenes.grip import Grip
from bellows_design.design.scenes.payload import Payload
from bellows_design.errors import DesignError
from bellows_design.files.toml_files import read_toml
from bellows_design.validation.quoting import did_you_mean, quoted, quoted_path, shown
from bellows_design.validation.sentences import sentences

Scene = Free | Blocked | Payload | Grip

KINDS: Mapping[str, type[Scene]] = {
    "free": Free,
    "blocked": Blocked,
    "payload": Payload,
    "grip": Grip,
}

BUILT_IN: Mapping[str, Scene] = {"free": Free(), "blocked": Blocked()}
"""Scenes that need no table, unless a design has one of that name."""

MOST_SCENES = 50
LONGEST_NAME = 64
_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_-]{0,63}")


class Scenes(dict[str, Scene]):
    """Scenes by their names, which stay as they are."""

    def _refuse(self, *_: object, **__: object) -> Any:
        raise TypeError("the scenes of a design cannot be changed; make another design")

    __setitem__ = __delitem__ = __ior__ = _refuse
    clear = pop = popitem = setdefault = update = _refuse

    def __reduce__(self) -> tuple[type[Scenes], tuple[dict[str, Scene]]]:
        return Scenes, (dict(self),)


def scene_of(table: Any, subject: str) -> Scene:
    """The scene that ``table`` describes; ``subject`` is what messages call it.

    Raises ``DesignError`` with one sentence for each problem.
    """
    if isinstance(table, Free | Blocked | Payload | Grip):
        return table
    if not isinstance(table, Mapping):
        raise DesignError(f"{subject} is {quoted(table)} but must be a table of keys and values.")
    kind = table.get("kind")
    if not isinstance(kind, str):
        raise DesignError(f"{subject}.kind is missing: one of {', '.join(KINDS)}.")
    if kind not in KINDS:
        raise DesignError(f"{subject}.kind is {quoted(kind)}{did_you_mean(kind, KINDS)}")
    try:
        return KINDS[kind].model_validate(dict(table))
    except ValidationError as error:
        found = sentences(error, KINDS[kind])
        raise DesignError(*(f"{subject}: {each}" for each in found)) from None


def scenes_of(tables: Any) -> dict[str, Scene]:
    """The scenes of a design by their names. Raises ``DesignError``."""
    if not isinstance(tables, Mapping):
        raise DesignError(f"scenes is {quoted(tables)} but must be a table of scenes.")
    if len(tables) > MOST_SCENES:
        raise DesignError(f"scenes has {len(tables)} entries but must have at most {MOST_SCENES}.")
    for name in tables:
        if not isinstance(name, str) or not _NAME.fullmatch(name):
            raise DesignError(
                f"scenes: the name {quoted(name)} must be 1 to 64 letters, digits, _ or -, and "
                "not begin with a digit or -."
            )
    return {name: scene_of(table, f"scenes.{name}") for name, table in tables.items()}


def check_fits(scene: Scene, subject: str, length: float) -> None:
    """Raise ``DesignError`` if a place along the finger lies beyond its ``length`` (mm)."""
    place = getattr(scene, "place", None)
    if place is not None and place > length:
        raise DesignError(
            f"{subject}: place = {place:g} mm lies beyond the finger's length of {length:g} mm."
        )


def named_scene(name_or_path: str, own: Mapping[str, Scene]) -> tuple[str, Scene]:
    """The scene of that name and the name, of ``own``, built in, or in the TOML file at that path.

    Raises ``DesignError``.
    """
    known = {**BUILT_IN, **own}
    if name_or_path in known:
        return name_or_path, known[name_or_path]
    if name_or_path.lower().endswith(".toml"):
        path = Path(name_or_path)
        table = read_toml(path, name_or_path, "scene")
        return shown(path.stem, LONGEST_NAME), scene_of(
            table, f"the scene {quoted_path(name_or_path)}"
        )
    raise DesignError(
        f"unknown scene {quoted(name_or_path)}{did_you_mean(name_or_path, sorted(known))}"
    )
