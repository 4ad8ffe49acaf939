"""The tables of a results file, and answers as their rows; docs/scale.md describes every column.

The columns of an answer are the fields of ``Answer``; what is no plain value is JSON.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any

from bellows_design.batch.answer import Answer
from bellows_design.design.design import Design

APPLICATION = 0x42454C57
"""``PRAGMA application_id`` of a results file: BELW."""

VERSION = 1
"""``PRAGMA user_version``: of these tables."""

TABLES = (
    """CREATE TABLE study (
        only INTEGER PRIMARY KEY CHECK (only = 1),
        kind TEXT NOT NULL,
        base TEXT NOT NULL,
        options TEXT NOT NULL,
        created TEXT NOT NULL,
        versions TEXT NOT NULL
    )""",
    """CREATE TABLE answer (
        key TEXT PRIMARY KEY NOT NULL,
        position INTEGER NOT NULL,
        varied TEXT NOT NULL,
        design TEXT,
        digest TEXT NOT NULL,
        status TEXT NOT NULL CHECK (status IN ('done', 'failed')),
        reason TEXT NOT NULL,
        bending_angle_deg REAL,
        bending_angle_error_percent REAL,
        max_von_mises_mpa REAL,
        max_von_mises_error_percent REAL,
        cavity_volume_mm3 REAL,
        highest_strain REAL,
        smallest_gap_mm REAL,
        warnings TEXT NOT NULL,
        origin TEXT NOT NULL,
        distance REAL NOT NULL,
        fallback TEXT NOT NULL,
        factorizations INTEGER NOT NULL,
        seconds REAL NOT NULL,
        derivatives TEXT
    )""",
)

OWN = ("position", "varied", "design")
"""Columns beside the fields of ``Answer``."""

AS_JSON = ("warnings", "derivatives")
"""Fields of ``Answer`` that are no plain values."""

COLUMNS = (*OWN, *(field.name for field in fields(Answer)))

KEEP = (
    f"INSERT INTO answer ({', '.join(COLUMNS)}) VALUES ({', '.join(':' + n for n in COLUMNS)}) "
    f"ON CONFLICT (key) DO UPDATE SET {', '.join(f'{n} = excluded.{n}' for n in COLUMNS[1:])} "
    "WHERE status = 'failed'"
)
"""A question is answered once: only a failure gives way to another answer."""


@dataclass(frozen=True)
class Row:
    """An answer, and what it answers.

    Attributes:
        answer: What was found, or why nothing was.
        design: The design that it is of; None where there can be none.
        varied: What of it was varied, by the names of ``bellows_design.design.variation``.
        position: In the order of the study.
    """

    answer: Answer
    design: Design | None = None
    varied: Mapping[str, float] | None = None
    position: int = 0


def values_of(row: Row, base: Mapping[str, Any]) -> dict[str, Any]:
    """The columns of a row; of its design the tables that differ from those of ``base``."""
    answer = {field.name: getattr(row.answer, field.name) for field in fields(Answer)}
    answer |= {name: _as_json(answer[name]) for name in AS_JSON}
    design = None if row.design is None else _differing(row.design.model_dump(mode="json"), base)
    return {
        "position": row.position,
        "varied": json.dumps(dict(row.varied or {})),
        "design": _as_json(design),
        **answer,
    }


def row_of(values: Mapping[str, Any], base: Mapping[str, Any]) -> Row:
    """The row that :func:`values_of` gave. Raises ``DesignError`` where its design is none now."""
    differing = _from_json(values["design"])
    design = None if differing is None else Design.of({**base, **differing})
    return Row(answer_in(values), design, json.loads(values["varied"]), values["position"])


def answer_in(values: Mapping[str, Any]) -> Answer:
    """The answer of a row, whatever its design is."""
    answer = {field.name: values[field.name] for field in fields(Answer)}
    answer |= {name: _from_json(answer[name]) for name in AS_JSON}
    answer["warnings"] = tuple(answer["warnings"])
    return Answer(**answer)


def _differing(table: Mapping[str, Any], base: Mapping[str, Any]) -> dict[str, Any]:
    return {name: value for name, value in table.items() if value != base.get(name)}


def _as_json(value: Any) -> str | None:
    return None if value is None else json.dumps(value)


def _from_json(text: str | None) -> Any:
    return None if text is None else json.loads(text)
