"""What is found for the designs of a study: one SQLite file that outlives whatever ends a process.

One process writes it, an answer a transaction; others may read it meanwhile. In the journal mode
WAL an answer that is written stays when the process is killed, and with ``synchronous=FULL`` also
when the machine loses its power: that costs a millisecond or so where an answer takes a second.
"""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Iterator, Mapping
from contextlib import ExitStack, closing, contextmanager
from dataclasses import dataclass, field
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from bellows_design.batch.answer import Answer
from bellows_design.batch.schema import (
    APPLICATION,
    KEEP,
    TABLES,
    VERSION,
    Row,
    answer_in,
    row_of,
    values_of,
)
from bellows_design.design.design import Design
from bellows_design.errors import DesignError
from bellows_design.files.errors import CannotWrite
from bellows_design.files.locks import locked
from bellows_design.validation.quoting import quoted_path
from bellows_design.versions import versions

NESTED = ("varied", "design")
"""Columns that hold tables."""

WAIT_SECONDS = 60.0
"""s. So long a write waits for a reader that keeps the file busy."""

END_SECONDS = 1.0
"""s. So long the end of a study waits for one: nothing depends on it."""


@dataclass(frozen=True)
class Study:
    """What a results file belongs to: only the same study continues it.

    Attributes:
        kind: ``sweep``, ``optimum`` and the like.
        base: The design that all others are varied from.
        options: Plain values that decide which questions are asked.
    """

    kind: str
    base: Design
    options: Mapping[str, Any] = field(default_factory=dict)


class Results:
    """An open results file; made by :func:`opened` and :func:`reading`."""

    def __init__(self, path: Path, connection: sqlite3.Connection) -> None:
        self._path, self._connection = path, connection
        self._study = connection.execute("SELECT * FROM study").fetchone()
        self._base = json.loads(self._study["base"])

    @property
    def study(self) -> Study:
        """What it belongs to. Raises ``DesignError`` where its base is no design any more."""
        options = json.loads(self._study["options"])
        return Study(self._study["kind"], Design.of(self._base), options)

    @property
    def versions(self) -> Mapping[str, str]:
        """Of the packages that the study was begun with."""
        return dict(json.loads(self._study["versions"]))

    def statuses(self) -> dict[str, str]:
        """Key of every answer -> ``done`` or ``failed``."""
        return dict(map(tuple, self._connection.execute("SELECT key, status FROM answer")))

    def keep(self, *rows: Row) -> None:
        """Write answers in one transaction; one that is there already stays unless it failed.

        Raises ``CannotWrite``: the disk is full, or the file is read only or gone.
        """
        try:
            with self._connection:
                self._connection.executemany(KEEP, (values_of(row, self._base) for row in rows))
        except sqlite3.Error as error:
            raise CannotWrite(self._path, error) from error

    def rows(self) -> Iterator[Row]:
        """Every answer, by its position."""
        for values in self._connection.execute("SELECT * FROM answer ORDER BY position, key"):
            yield row_of(values, self._base)

    def answers(self) -> Iterator[Answer]:
        """The same without their designs, each of which would be validated."""
        for values in self._connection.execute("SELECT * FROM answer ORDER BY position, key"):
            yield answer_in(values)

    def row(self, key: str) -> Row | None:
        """The answer to one question; None if there is none yet."""
        found = self._connection.execute("SELECT * FROM answer WHERE key = ?", (key,)).fetchone()
        return None if found is None else row_of(found, self._base)

    def flat_columns(self) -> dict[str, str]:
        """Columns of :meth:`flat_rows`, each with its type as SQLite states it."""
        stated = self._connection.execute("PRAGMA table_info(answer)")
        types = {row["name"]: row["type"] for row in stated if row["name"] not in NESTED}
        names: dict[str, str] = {}
        for (text,) in self._connection.execute("SELECT DISTINCT varied FROM answer"):
            names |= dict.fromkeys(json.loads(text), "REAL")
        return {"position": types.pop("position"), **names, **types}

    def flat_rows(self) -> Iterator[dict[str, Any]]:
        """Every answer as plain values, with one for each parameter that was varied."""
        for values in self._connection.execute("SELECT * FROM answer ORDER BY position, key"):
            plain = {name: value for name, value in dict(values).items() if name not in NESTED}
            yield plain | json.loads(values["varied"])


@contextmanager
def opened(path: Path, study: Study) -> Iterator[Results]:
    """The results of a study, to be continued; begun where there is no file. One process at once.

    After the block all of it is in this one file, unless another process reads it just then: what
    is in the file ``-wal`` beside it then is as safe, and joins it with the next use.

    Raises:
        DesignError: The file is damaged, none of this program, or another study's; or another
            process writes it.
        CannotWrite: It cannot be written.
    """
    with _alone(path), _connected(path, f"file:{_quoted(path)}?mode=rwc") as connection:
        _require_ours(path, connection)
        _begin(path, connection, study)
        results = Results(path, connection)
        _require_same(path, results.study, study)
        yield results
        connection.execute(f"PRAGMA busy_timeout = {1000 * END_SECONDS:.0f}")
        connection.execute("PRAGMA wal_checkpoint(TRUNCATE)")


@contextmanager
def reading(path: Path) -> Iterator[Results]:
    """The results in a file, also while another process writes them. Raises ``DesignError``."""
    if not path.is_file():
        raise DesignError(f"there is no file {quoted_path(path)}.")
    with _connected(path, f"file:{_quoted(path)}?mode=rw") as connection:
        connection.execute("PRAGMA query_only = 1")
        _require_ours(path, connection)
        if _is_empty(connection):
            raise DesignError(f"{quoted_path(path)} holds no study yet.")
        yield Results(path, connection)


@contextmanager
def _alone(path: Path) -> Iterator[None]:
    """Within the block no other process writes the file: a file beside it is locked.

    The file itself is not, as some systems take locks of both kinds, SQLite's and ours, for one.
    """
    beside = path.with_name(f".{path.name}.lock")
    with ExitStack() as stack:
        try:
            beside.touch(mode=0o600)
            stack.enter_context(locked(beside))
        except TimeoutError:
            raise DesignError(
                f"another process is writing {quoted_path(path)}; wait for it, or name another "
                "file."
            ) from None
        except OSError as error:
            raise CannotWrite(path, error) from error
        stack.callback(beside.unlink, missing_ok=True)
        yield


@contextmanager
def _connected(path: Path, address: str) -> Iterator[sqlite3.Connection]:
    """A connection for the length of the block, whose errors are sentences."""
    try:
        with closing(sqlite3.connect(address, timeout=WAIT_SECONDS, uri=True)) as connection:
            connection.row_factory = sqlite3.Row
            yield connection
    except sqlite3.OperationalError as error:  # no such folder, no right, a full disk
        raise CannotWrite(path, error) from error
    except sqlite3.DatabaseError as error:
        raise DesignError(f"{quoted_path(path)} is no results file, or damaged: {error}.") from None


def _require_ours(path: Path, connection: sqlite3.Connection) -> None:
    """Refuse what another program wrote, what is newer than this one, and what is damaged."""
    if _is_empty(connection):
        return
    application, version = (_pragma(connection, n) for n in ("application_id", "user_version"))
    if application != APPLICATION:
        raise DesignError(f"{quoted_path(path)} is a database of another program.")
    if version != VERSION:
        raise DesignError(
            f"{quoted_path(path)} has tables of version {version}; this program reads version "
            f"{VERSION}."
        )
    state = _pragma(connection, "quick_check(1)")
    if state != "ok":
        raise DesignError(f"{quoted_path(path)} is damaged: {state}.")


def _is_empty(connection: sqlite3.Connection) -> bool:
    return connection.execute("SELECT count(*) FROM sqlite_master").fetchone()[0] == 0


def _begin(path: Path, connection: sqlite3.Connection, study: Study) -> None:
    """Make the tables, all or none, where there are none."""
    _pragma(connection, "journal_mode = WAL")
    connection.execute("PRAGMA synchronous = FULL")
    if not _is_empty(connection):
        return
    row = {
        "kind": study.kind,
        "base": json.dumps(study.base.model_dump(mode="json")),
        "options": json.dumps(dict(study.options)),
        "created": datetime.now(UTC).isoformat(timespec="seconds"),
        "versions": json.dumps(versions()),
    }
    with connection:
        connection.execute("BEGIN IMMEDIATE")
        for statement in TABLES:
            connection.execute(statement)
        connection.execute(f"PRAGMA application_id = {APPLICATION}")
        connection.execute(f"PRAGMA user_version = {VERSION}")
        names = ", ".join(f":{name}" for name in row)
        connection.execute(f"INSERT INTO study VALUES (1, {names})", row)


def _require_same(path: Path, found: Study, study: Study) -> None:
    """Refuse a file that another study began."""
    options = json.loads(json.dumps(dict(study.options)))
    differing = [
        *(["kind"] if found.kind != study.kind else []),
        *(["design"] if found.base.digest != study.base.digest else []),
        *sorted(n for n in {*found.options, *options} if found.options.get(n) != options.get(n)),
    ]
    if differing:
        raise DesignError(
            f"{quoted_path(path)} holds another study, which differs in {', '.join(differing)}; "
            "name another file, or repeat the options that it was begun with."
        )


def _pragma(connection: sqlite3.Connection, name: str) -> Any:
    return connection.execute(f"PRAGMA {name}").fetchone()[0]


def _quoted(path: Path) -> str:
    from urllib.parse import quote

    return quote(str(path.absolute()))
