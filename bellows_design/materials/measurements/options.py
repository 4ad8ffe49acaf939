"""What a reader may be told where a file leaves it open."""

from __future__ import annotations

from dataclasses import dataclass

from bellows_design.errors import DesignError
from bellows_design.validation.quoting import did_you_mean, quoted

DECIMALS = {"point": ".", "comma": ","}
BRANCHES = ("first", "last", "all", "specimens")
KEPT = ("zero", "break")


@dataclass(frozen=True)
class ReadingOptions:
    """How a table of measurements is to be read; every field may stay as it is.

    Attributes:
        columns: Names of the columns in their order, as a header would have them (``-`` for one to
            be left out), or ``strain=2,stress_mpa=4`` by their numbers. Instead of the header.
        units: ``stress=kPa,strain=%``: units by quantity, instead of the header's.
        skip: Lines to leave out: ``4`` the first four, ``70-`` from the 70th, ``3-5``; several
            separated by commas.
        decimal: ``point`` or ``comma``.
        branch: Of a test that goes to and fro: ``first`` loading, ``last`` loading, ``all``
            points; ``specimens`` if each return is a new specimen. None: the first.
        keep: ``zero``: strain and stress as they are, without looking for preload and toe;
            ``break``: also the points after break.
        true_stress: The stress is true (Cauchy) stress, force over present area.
        true_strain: The strain is true (logarithmic, Hencky) strain.
        area: Initial area that forces are divided by, mm².
        gauge_length: Initial length that extensions are divided by, mm.

    Raises:
        DesignError: A value is none of these.

    Examples:
        >>> from pathlib import Path
        >>> from bellows_design.materials import ReadingOptions, load_measurements
        >>> _ = Path("test.txt").write_text("5;50\\n10;100\\n20;180\\n40;310\\n80;500\\n")
        >>> units = "strain=%,stress=kPa"
        >>> options = ReadingOptions(columns="strain,stress", units=units, keep=("zero",))
        >>> print(load_measurements("test.txt", options).stress, "MPa")
        [0.05 0.1  0.18 0.31 0.5 ] MPa
    """

    columns: str | None = None
    units: str | None = None
    skip: str | None = None
    decimal: str | None = None
    branch: str | None = None
    keep: tuple[str, ...] = ()
    true_stress: bool = False
    true_strain: bool = False
    area: float | None = None
    gauge_length: float | None = None

    def __post_init__(self) -> None:
        for option, value, known in (
            ("--decimal", self.decimal, tuple(DECIMALS)),
            ("--branch", self.branch, BRANCHES),
            *(("--keep", each, KEPT) for each in self.keep),
        ):
            if value is not None and value not in known:
                raise DesignError(f"{option} is {quoted(value)}{did_you_mean(value, known)}")
        for option, size, most, unit in (
            ("--area", self.area, 1e5, "mm²"),
            ("--gauge-length", self.gauge_length, 1e4, "mm"),
        ):
            if size is not None and not 1e-3 <= size <= most:
                raise DesignError(
                    f"{option} is {size:g} {unit} but must lie between 0.001 and {most:g} {unit}."
                )
