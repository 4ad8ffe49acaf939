"""What the columns of a kind of test are called, and in which units they may be.

The reader of tables knows no quantity itself: a vocabulary has its names, its units, and the words
of its messages. ``TENSION`` is that of the tests a material is fitted to.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from functools import cached_property

from bellows_design.materials.measurements.table.units import ALL, UNITS

Words = Mapping[str, str]
"""Quantity -> words, separated by spaces."""


@dataclass(frozen=True, eq=False)
class Vocabulary:
    """Names and units of the columns of a kind of test.

    Attributes:
        words: Quantity -> what its columns are called, in lower case. Of several quantities that a
            name may be, the first is taken.
        qualifiers: Quantity -> words that may stand beside its name and say nothing else.
        true: The same for words that say that it is counted in the deformed body.
        units: Quantity -> its units and their factors.
        by_unit: Quantity -> others that its name means where their unit stands behind it.
        known_units: All units that may stand in a table.
        needed: A line names columns if it has one quantity of each of these groups.
        texts: Quantities whose cells hold words.
        examples: What ``--columns`` may say.
        numbered: The same by the numbers of columns.
        units_example: What ``--units`` may say.
        names: Sentence on the names that ``--columns`` knows.
        lacking: What a line of names lacks that names no test.
    """

    words: Words
    units: Mapping[str, Mapping[str, float]]
    needed: tuple[frozenset[str], ...]
    examples: tuple[str, ...]
    numbered: str
    units_example: str
    names: str
    lacking: str
    qualifiers: Words = field(default_factory=dict)
    true: Words = field(default_factory=dict)
    by_unit: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    known_units: frozenset[str] = ALL
    texts: tuple[str, ...] = ("mode", "specimen")

    @cached_property
    def quantities(self) -> Mapping[str, frozenset[str]]:
        """Word -> the quantities that are called so."""
        found: dict[str, set[str]] = {}
        for quantity, words in self.words.items():
            for word in words.split():
                found.setdefault(word, set()).add(quantity)
        return {word: frozenset(names) for word, names in found.items()}

    @cached_property
    def trues(self) -> Mapping[str, frozenset[str]]:
        """Quantity -> words that say that it is counted in the deformed body."""
        return {quantity: frozenset(words.split()) for quantity, words in self.true.items()}

    @cached_property
    def beside(self) -> Mapping[str, frozenset[str]]:
        """Quantity -> all words that may stand beside its name."""
        plain = {name: frozenset(words.split()) for name, words in self.qualifiers.items()}
        return {
            name: plain.get(name, frozenset()) | self.trues.get(name, frozenset())
            for name in self.words
        }

    def units_of(self, quantity: str | None) -> Mapping[str, float]:
        """Units that a column of that name may have, and their factors; none for no quantity."""
        meant = (quantity or "", *self.by_unit.get(quantity or "", ()))
        return {unit: size for name in meant for unit, size in self.units.get(name, {}).items()}

    def with_unit(self, quantity: str, unit: str) -> str | None:
        """What a column of that name holds that has this unit; None if it cannot have it."""
        meant = (quantity, *self.by_unit.get(quantity, ()))
        if not any(name in self.units for name in meant):
            return quantity
        return next((name for name in meant if unit in self.units.get(name, {})), None)

    def names_a_test(self, quantities: Collection[str | None]) -> bool:
        """Whether columns of these quantities make a test."""
        return all(group & set(quantities) for group in self.needed)


TENSION = Vocabulary(
    words={
        "strain": "strain dehnung déformation deformación deformazione ε epsilon",
        "stress": "stress spannung zugspannung contrainte esfuerzo σ sigma",
        "stretch": "stretch λ lambda",
        "force": "force load kraft zugkraft standardkraft prüfkraft fuerza forza",
        "extension": "extension displacement weg standardweg traversenweg stroke crosshead "
        "position verlängerung längenänderung allongement",
        "elongation": "elongation",
        "time": "time zeit prüfzeit temps tiempo tempo",
        "mode": "mode",
        "specimen": "specimen sample probe probekörper éprouvette",
        "cycle": "cycle cycles zyklus",
        "other": "temperature temperatur temp index point nr no row",
    },
    qualifiers={
        "strain": "nominal engineering eng technical technische tensile axial longitudinal "
        "compressive extension displacement extensometer crosshead",
        "stress": "nominal engineering eng technical technische tensile axial longitudinal "
        "compressive standard",
        "stretch": "ratio axial longitudinal",
        "force": "standard axial tensile cell compressive",
        "extension": "tensile axial compressive standard",
        "elongation": "tensile axial",
        "time": "test elapsed total",
        "specimen": "id number name no",
        "cycle": "number count total elapsed no",
    },
    true={
        "strain": "true log logarithmic hencky wahre natural",
        "stress": "true cauchy wahre",
    },
    units=UNITS,
    by_unit={"elongation": ("strain", "extension"), "strain": ("extension",)},
    needed=(
        frozenset(("strain", "stretch", "extension", "elongation")),
        frozenset(("stress", "force")),
    ),
    examples=("stretch,stress_mpa", "strain_percent,stress_mpa"),
    numbered="strain=1,stress_mpa=2",
    units_example="stress=kPa,strain=%,force=N,extension=mm",
    names="known are strain, stretch, extension, stress, force, true_strain, true_stress, time, "
    "mode and specimen, with a unit behind (stress_mpa, strain_percent), and - for a column to "
    "leave out.",
    lacking="none is a strain or none is a stress",
)
"""Of tests that a material is fitted to."""
