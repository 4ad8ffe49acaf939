"""Printer profiles and filaments as TOML files: shipped, of other packages, and a user's own.

Profiles ship in `profiles/`, filaments in `filaments/`; other packages add theirs through the
entry-point groups `bellows_design.printers` and `bellows_design.filaments`.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from printers.errors import PrintersError, quoted
from printers.library.inheritance import NOWHERE, Origin, own_table, with_parents
from printers.library.library import Library
from printers.profile import Filament, PrinterProfile
from printers.profile.filament import ADVISED

PROFILES = Library("printer profile", "profiles", "bellows_design.printers", ("filament",))
FILAMENTS = Library("filament", "filaments", "bellows_design.filaments")


def available_profiles() -> tuple[str, ...]:
    """Names of the shipped profiles and of those that other installed packages bring, sorted.

    Returns:
        Names that `load_profile` knows.

    Raises:
        PrintersError: An installed package announces profiles but cannot be imported.

    Examples:
        >>> from printers import available_profiles
        >>> print("prusa_i3" in available_profiles())
        True
    """
    return PROFILES.names()


def available_filaments() -> tuple[str, ...]:
    """Names of the shipped filaments and of those that other installed packages bring, sorted.

    Returns:
        Names that `load_filament` knows.

    Raises:
        PrintersError: An installed package announces filaments but cannot be imported.

    Examples:
        >>> from printers import available_filaments
        >>> print("ninjaflex_85a" in available_filaments())
        True
    """
    return FILAMENTS.names()


def load_profile(name_or_path: str | Path) -> PrinterProfile:
    """Load a profile by its name, or from a path that ends in `.toml`.

    Shipped profiles cannot be replaced by another package's of the same name. A profile that
    extends another has all its keys but the name; a filament may stand as a name, a file or a
    table, and gives the temperatures and flows that the profile leaves out.

    Args:
        name_or_path: A name, as `available_profiles` lists them, or a file.

    Returns:
        The checked profile.

    Raises:
        PrintersError: One sentence on an unknown name, a missing or unreadable file, an unknown
            key, NaN or a value out of bounds.

    Examples:
        >>> from printers import load_profile
        >>> print(load_profile("prusa_i3").nozzle_diameter, "mm")
        0.4 mm
    """
    table, origin = own_table(PROFILES, name_or_path)
    try:
        return profile_from_table(table, origin)
    except PrintersError as error:
        raise PrintersError(f"printer profile {quoted(str(name_or_path))}: {error}") from None


def load_filament(name_or_path: str | Path) -> Filament:
    """Load a filament by its name, or from a path that ends in `.toml`.

    Args:
        name_or_path: A name, as `available_filaments` lists them, or a file.

    Returns:
        The checked filament.

    Raises:
        PrintersError: As `load_profile`.

    Examples:
        >>> from printers import load_filament
        >>> print(load_filament("cheetah_95a").nozzle_temperature, "°C")
        240.0 °C
    """
    table, origin = own_table(FILAMENTS, name_or_path)
    try:
        return Filament(**with_parents(FILAMENTS, table, origin))
    except PrintersError as error:
        raise PrintersError(f"filament {quoted(str(name_or_path))}: {error}") from None


def with_filament(profile: PrinterProfile, name_or_path: str | Path) -> PrinterProfile:
    """The profile with another filament: its temperatures and its greatest flow.

    The multiplier of the extrusion stays the profile's, which it chose so that walls seal.

    Args:
        profile: The printer.
        name_or_path: A filament's name, as `available_filaments` lists them, or a file.

    Returns:
        The checked profile.

    Raises:
        PrintersError: As `load_profile`; or the print speed asks for more than the filament's flow.
    """
    filament = load_filament(name_or_path)
    settings = {key: getattr(filament, key) for key in ADVISED if key != "flow"}
    table = profile.model_dump()
    slicer = table["slicer"] | settings
    try:
        return PrinterProfile(**(table | {"filament": filament, "slicer": slicer}))
    except PrintersError as error:
        raise PrintersError(f"filament {quoted(str(name_or_path))}: {error}") from None


def profile_from_table(table: Mapping[str, Any], origin: Origin = NOWHERE) -> PrinterProfile:
    """A profile from the keys of a file: it may extend another and name its filament.

    Args:
        table: The keys; a whole profile as `PrinterProfile.model_dump` gives it is one too.
        origin: Where the table stands, so that the paths in it are found.

    Returns:
        The checked profile.

    Raises:
        PrintersError: As `load_profile`.

    Examples:
        >>> from printers import profile_from_table
        >>> lab = profile_from_table({"extends": "prusa_i3", "name": "lab", "minimum_gap": 0.6})
        >>> print(lab.minimum_gap, lab.nozzle_diameter)  # mm
        0.6 0.4
    """
    whole = with_parents(PROFILES, table, origin)
    filament = _filament(whole.get("filament"), origin)
    return PrinterProfile(**(whole if filament is None else _filled(whole, filament)))


def _filament(named: Any, origin: Origin) -> Filament | None:
    """The filament that a profile names or holds; None if it does neither."""
    if isinstance(named, str):
        return load_filament(named)
    if not isinstance(named, Mapping):
        return None
    try:
        return Filament(**with_parents(FILAMENTS, named, origin))
    except PrintersError as error:
        raise PrintersError(f"filament: {error}") from None


def _filled(table: dict[str, Any], filament: Filament) -> dict[str, Any]:
    """The table with the whole filament, and the filament's settings where it has none."""
    slicer = table.get("slicer")
    if isinstance(slicer, Mapping):
        slicer = {key: getattr(filament, key) for key in ADVISED} | dict(slicer)
    return table | {"filament": filament} | ({} if slicer is None else {"slicer": slicer})
