"""``bellows list``: what may be named, with a line on each."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING

from bellows_design.cli.answer import Answer
from bellows_design.cli.starting.kinds import Listed

if TYPE_CHECKING:
    from rich.console import RenderableType


def list_known(what: Listed = Listed.DESIGNS) -> Answer:
    """Names and descriptions of what ships, and of what other packages bring."""
    kinds = [each for each in Listed if each is not Listed.ALL] if what is Listed.ALL else [what]
    found = {kind.value: LISTS[kind]() for kind in kinds}
    text: list[RenderableType] = []
    for name, entries in found.items():
        text.append(_table(entries, name if len(found) > 1 else ""))
    return Answer(found, text)


def _table(entries: Mapping[str, str], title: str) -> RenderableType:
    from rich.table import Table
    from rich.text import Text

    table = Table(title=title or None, title_justify="left", box=None, show_header=False)
    table.add_column(no_wrap=True)
    table.add_column()
    for name, about in entries.items():
        table.add_row(Text(name), Text(about))
    return table


def _designs() -> dict[str, str]:
    from bellows_design.design.shipped import load_design, shipped_designs

    return {name: load_design(name).description for name in shipped_designs()}


def _materials() -> dict[str, str]:
    from bellows_design.materials.library import load_material, material_names

    found = {}
    for name in material_names():
        material = load_material(name)
        found[name] = f"{material.model}, yield strength {material.yield_strength:g} MPa"
    return found


def _printers() -> dict[str, str]:
    from printers import available_profiles, load_profile

    return _described(available_profiles(), lambda name: load_profile(name).description)


def _filaments() -> dict[str, str]:
    from printers import available_filaments, load_filament

    return _described(available_filaments(), lambda name: load_filament(name).description)


def _described(names: Iterable[str], describe: Callable[[str], str]) -> dict[str, str]:
    return {name: describe(name) for name in names}


def _scenes() -> dict[str, str]:
    from bellows_design.design.scenes.scene import BUILT_IN, KINDS

    table = " (needs keys: bellows init scene FILE --from {name})"
    return {
        name: (kind.__doc__ or "").split("\n")[0] + table.format(name=name) * (name not in BUILT_IN)
        for name, kind in KINDS.items()
    }


def _keys() -> dict[str, str]:
    from bellows_design.cli.completion.settings import described_keys

    return described_keys()


LISTS: Mapping[Listed, Callable[[], dict[str, str]]] = {
    Listed.DESIGNS: _designs,
    Listed.MATERIALS: _materials,
    Listed.PRINTERS: _printers,
    Listed.FILAMENTS: _filaments,
    Listed.SCENES: _scenes,
    Listed.KEYS: _keys,
}
