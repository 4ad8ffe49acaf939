"""The way from a folder to what is true of it."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bellows_design.budget import DEFAULT, Budget
from bellows_design.errors import BellowsError
from bellows_design.export.manifest import MANIFEST
from bellows_design.progress import SILENCE, Progress
from bellows_design.validation.quoting import shown
from bellows_design.verification.differences import (
    MOST,
    field_differences,
    now,
    quick_part,
    then,
    version_differences,
)
from bellows_design.verification.folder import checked_files, sealed_manifest
from bellows_design.verification.record import FileCheck, Verification

if TYPE_CHECKING:
    from bellows_design.approval import Verdict
    from bellows_design.design.design import Design
    from bellows_design.export.part import Part
    from bellows_design.leak_test.record import LeakTester, Unavailable
    from bellows_design.store.store import Store


@dataclass(frozen=True)
class Means:
    """What a rebuild may use: as for ``pipeline.run``."""

    progress: Progress = SILENCE
    budget: Budget = DEFAULT
    store: Store | None = None
    leak_tester: LeakTester | Unavailable | None = None


@dataclass(frozen=True)
class Again:
    """What this version makes of a design.

    Attributes:
        part: Solid and mesh.
        verdict: On the design.
        files: Name -> content, as far as they were made.
        statement: Fields of the manifest, as far as they are known.
        slicer: That the leak test was made with.
    """

    part: Part
    verdict: Verdict
    files: Mapping[str, bytes]
    statement: Mapping[str, Any]
    slicer: str | None = None


def verify(folder: Path, quick: bool = False, means: Means | None = None) -> Verification:
    """Check every file of an export, and build, check, evaluate and decide its design again.

    Args:
        folder: Of the export.
        quick: Leave out evaluation and leak test, and the files that need them.
        means: Progress, budget, store and leak tester.

    Raises:
        DesignError: The folder is no export.
        MeshingError: No usable mesh, or none in time.
    """
    from printers.errors import PrintersError

    found = sealed_manifest(folder)
    if isinstance(found, FileCheck):
        return Verification(folder, "", "", (found,), quick=quick)
    manifest, content = found
    name, digest = (shown(str(manifest.get(key, "")), 64) for key in ("name", "digest"))
    plain = Verification(
        folder, name, digest, checked_files(folder, manifest, content), quick=quick
    )
    try:
        return _rebuilt(plain, manifest, content, means or Means())
    except (BellowsError, PrintersError) as error:
        return replace(plain, failure=str(error).rstrip("."))


def _rebuilt(
    plain: Verification, manifest: Mapping[str, Any], content: bytes, means: Means
) -> Verification:
    """What was found of the files, and what this version makes of the design."""
    from bellows_design.verification.agreement import others
    from bellows_design.verification.rebuild import (
        compared,
        compared_manifest,
        design_of,
        unexpected,
    )

    design = design_of(manifest)
    again = _quickly(design, means) if plain.quick else _wholly(design, means)
    versions = version_differences(then(plain, manifest), now(plain, again.slicer))
    other = others(versions)
    stated = quick_part(manifest) if plain.quick else manifest
    fields = field_differences(stated, again.statement)
    same = again.files.get(MANIFEST) == content
    own = () if plain.quick and not fields else (compared_manifest(same, fields, other),)
    return replace(
        plain,
        rebuilt=(
            *own,
            *compared(plain.folder, manifest, again.part, again.files, other),
            *unexpected(manifest, again.part),
        ),
        versions=versions,
        verdict=again.verdict,
        fields=fields[:MOST],
    )


def _quickly(design: Design, means: Means) -> Again:
    """What needs no evaluation."""
    from bellows_design.approval import without_evaluation
    from bellows_design.export.companions import settings_files
    from bellows_design.export.contents import part_files
    from bellows_design.export.statements import plain_statement
    from bellows_design.pipeline import build_part, check

    means.progress.stage("geometry")
    part = build_part(design)
    means.progress.stage("check")
    report = check(design, part)
    files = part_files(part) | settings_files(part)
    statement = plain_statement(design, report) | {"verdict.approved": True}
    return Again(part, without_evaluation(report), files, statement)


def _wholly(design: Design, means: Means) -> Again:
    from bellows_design.export.statements import files_of
    from bellows_design.pipeline import examine

    found = examine(design, means.progress, means.budget, means.store, means.leak_tester)
    means.progress.stage("compare")
    files = files_of(found)
    return Again(
        found.part, found.verdict, files, json.loads(files[MANIFEST]), found.leak_test.slicer
    )
