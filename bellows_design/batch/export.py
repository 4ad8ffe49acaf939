"""The answers of a results file as one flat table: CSV, or Parquet with the extra ``parquet``.

Its columns are those of the file, but for the design, and one for each parameter that was varied.
"""

from __future__ import annotations

import csv
from collections.abc import Iterator
from importlib import import_module
from importlib.util import find_spec
from itertools import islice
from pathlib import Path
from typing import Any

from bellows_design.batch.results import Results
from bellows_design.errors import DesignError
from bellows_design.files.atomic import replacing

ROWS_AT_ONCE = 10_000
"""Of Parquet: a group of rows is compressed at once, and in memory meanwhile."""

PARQUET_TYPES = {"TEXT": "string", "INTEGER": "int64", "REAL": "float64"}
"""For the types of columns that SQLite states."""


def write_csv(results: Results, path: Path) -> None:
    """Write all answers as CSV, UTF-8, completely or not at all; None is an empty field.

    Raises ``CannotWrite``, an ``OSError``.
    """
    columns = results.flat_columns()
    with replacing(path) as temporary, temporary.open("w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, list(columns))
        writer.writeheader()
        writer.writerows(results.flat_rows())


def write_parquet(results: Results, path: Path) -> None:
    """Write all answers as Parquet, completely or not at all; None is null.

    Raises ``CannotWrite``, an ``OSError``, and ``DesignError`` without pyarrow.
    """
    require_pyarrow()
    arrow, parquet = import_module("pyarrow"), import_module("pyarrow.parquet")
    types = {name: PARQUET_TYPES[kind] for name, kind in results.flat_columns().items()}
    schema = arrow.schema(types)
    with replacing(path) as temporary, parquet.ParquetWriter(temporary, schema) as writer:
        for rows in _groups(results.flat_rows()):
            columns = {name: [row.get(name) for row in rows] for name in types}
            writer.write_table(arrow.table(columns, schema))


def require_pyarrow() -> None:
    """Raise ``DesignError`` if it is not installed. Imports nothing."""
    if find_spec("pyarrow") is None:
        raise DesignError(
            "Parquet needs pyarrow, which comes with the extra “parquet”: "
            "pip install -e '.[parquet]'."
        )


def _groups(rows: Iterator[dict[str, Any]]) -> Iterator[list[dict[str, Any]]]:
    while group := list(islice(rows, ROWS_AT_ONCE)):
        yield group
