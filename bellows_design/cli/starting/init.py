"""``bellows init``: a commented file to start from."""

from __future__ import annotations

from pathlib import Path

from bellows_design.cli.answer import Answer
from bellows_design.cli.output_files import require_file
from bellows_design.cli.starting.kinds import Kind
from bellows_design.errors import DesignError
from bellows_design.validation.quoting import quoted

NEXT = {
    Kind.DESIGN: "bellows run {file}",
    Kind.SCENE: "bellows force finger --scene {file}",
    Kind.PRINTER: "bellows check finger --printer {file}",
    Kind.FILAMENT: "bellows check finger --filament {file}",
    Kind.MATERIAL: "bellows evaluate finger --set material={file}",
    Kind.BODY: "bellows evaluate {file}",
}
"""What it is used with."""


def init(kind: Kind, file: Path, force: bool, source: str | None = None) -> Answer:
    """Write a commented file to start from; replace another only if ``force`` says so.

    Its values are those of ``source``, a name or a file.
    """
    from bellows_design.cli.starting.templates import name_from, template
    from bellows_design.files.atomic import replacing

    require_file(file, ".toml")
    if file.exists() and not force:
        raise DesignError(f"{quoted(str(file))} is there already; --force replaces it.")
    text = template(kind, name_from(file.stem), source)
    with replacing(file) as temporary:
        temporary.write_text(text, "utf-8")
    following = f"edit it, then: {NEXT[kind].format(file=file)}"
    return Answer({"kind": kind.value, "file": str(file)}, [f"{file}: a {kind.value}", following])
