"""Laws in the store: found by all that decides their numbers, made again from plain values."""

from __future__ import annotations

from dataclasses import asdict, replace
from datetime import UTC, datetime
from typing import TYPE_CHECKING

from bellows_design.budget import Budget
from bellows_design.design.design import Design
from bellows_design.force.law.half_bubble import CellLaw
from bellows_design.progress import Progress
from bellows_design.store.key import Key, plain, present_surroundings
from bellows_design.store.store import LAWS, Store
from bellows_design.store.values import Arrays, restored
from bellows_design.store.values import plain as plain_record

if TYPE_CHECKING:
    from collections.abc import Mapping
    from typing import Any

    from numpy.typing import NDArray


def key_of_law(design: Design, tolerance: float, budget: Budget) -> Key:
    """What the law of a design is found by."""
    asked = {
        "design": design.as_evaluated.digest,
        "valid_strain": design.material.valid_strain,
        "tolerance": float(tolerance),
        "budget": {name: float(limit) for name, limit in asdict(budget).items()},
    }
    return Key(plain(asked), present_surroundings())


def key_of_extension(
    key: Key, moments: tuple[float, float], pressures: tuple[float, float] | None
) -> Key:
    """What a law is found by that is the one of ``key``, extended to these moments.

    By itself, so that what a scene is told does not depend on scenes that were asked for before.
    """
    asked = {"law": key.asked, "moments": moments, "pressures": pressures}
    return Key(plain(asked), key.surroundings)


def find(store: Store | None, key: Key, design: Design) -> CellLaw | None:
    """The law of ``design`` that is kept under ``key``; None if there is none."""

    def made(values: Mapping[str, Any], arrays: Mapping[str, NDArray[Any]]) -> CellLaw:
        found: CellLaw = restored(CellLaw, values["law"], arrays, {Design: lambda _: design})
        return found

    return None if store is None else store.of_kind(LAWS).find_record(key, made)


def keep(store: Store | None, key: Key, law: CellLaw) -> None:
    """Keep a law. Raises ``OSError`` if the file cannot be written."""
    if store is None:
        return
    arrays: Arrays = {}
    values = {"law": plain_record(law, arrays, {Design: lambda _: None})}
    store.of_kind(LAWS).keep_record(key, values, arrays)


def keep_noted(store: Store | None, key: Key, law: CellLaw, progress: Progress) -> None:
    """Keep a law with the present time, or note that it could not be."""
    from bellows_design.store.store import written

    try:
        keep(store, key, replace(law, from_cache=written(datetime.now(UTC))))
    except OSError as error:
        progress.note(f"the section's law is not kept: {error}")
