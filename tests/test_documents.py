"""Links, anchors and paths in the documents lead somewhere; references leave nothing out."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from fnmatch import fnmatch
from functools import cache
from itertools import count
from pathlib import Path
from typing import Any

import pytest

from bellows_design.design import Design
from bellows_design.design.overrides import known_keys
from bellows_design.materials import material_names
from printers import (
    RULES,
    Filament,
    PrinterProfile,
    SlicerAdvice,
    available_filaments,
    available_profiles,
)

ROOT = Path(__file__).parents[1]
DOCS = sorted((ROOT / "docs").glob("*.md"))
OPTIONAL = [path for path in [ROOT / "CONTRIBUTING.md"] if path.exists()]
DOCUMENTS = [ROOT / "README.md", ROOT / "CHANGELOG.md", *OPTIONAL, *DOCS]
GENERATED = ROOT / "docs/generated"
"""Pages that are written when the site is built."""
BLOCK = re.compile(r"^```.*?^```", re.MULTILINE | re.DOTALL)
LINK = re.compile(r"\]\(([^()\s]+)\)")
CODE = re.compile(r"`([^`\n]+)`")
PATH = re.compile(r"\.{0,2}[A-Za-z0-9_-][A-Za-z0-9_.-]*(/[A-Za-z0-9_.-]+)+/?|[A-Za-z0-9_.-]+/")
PLACEHOLDER = "NAME"
"""In a path: any name."""

each_document = pytest.mark.parametrize(
    "document", DOCUMENTS, ids=lambda path: path.relative_to(ROOT).as_posix()
)


ENVIRONMENT = ".venv/"
"""What it holds stands in no repository."""


@cache
def text_of(document: Path) -> str:
    """A document without its blocks of code."""
    return BLOCK.sub("", document.read_text("utf-8"))


@cache
def anchors(document: Path) -> frozenset[str]:
    """What GitHub calls the headings of a document."""
    found: set[str] = set()
    for heading in re.findall(r"^#+ (.+)$", text_of(document), re.MULTILINE):
        plain = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", heading).lower()
        slug = re.sub(r"[^\w -]", "", plain).strip().replace(" ", "-")
        names = (slug if number == 0 else f"{slug}-{number}" for number in count())
        found.add(next(name for name in names if name not in found))
    return frozenset(found)


def local_links(document: Path) -> list[str]:
    """Targets of all links that lead to no other site."""
    return [link for link in LINK.findall(text_of(document)) if "://" not in link]


@cache
def generated_pages() -> frozenset[str]:
    """File names of the pages that are written when the site is built."""
    from generators.pages import generated

    return frozenset(generated(GENERATED))


@each_document
def test_every_link_leads_to_a_file_and_a_heading(document: Path) -> None:
    broken = []
    for link in local_links(document):
        path, _, anchor = link.partition("#")
        target = (document.parent / path).resolve() if path else document
        if target.parent == GENERATED:
            if target.name not in generated_pages():
                broken.append(link)
        elif not target.exists() or (anchor and anchor not in anchors(target)):
            broken.append(link)
    assert not broken


@each_document
def test_every_path_named_in_code_exists(document: Path) -> None:
    """Paths count from the top of the repository or from the document."""
    missing = []
    for code in CODE.findall(text_of(document)):
        for word in code.split():
            known = word.startswith(ENVIRONMENT) or exists(ROOT, word)
            if PATH.fullmatch(word) and not (known or exists(document.parent, word)):
                missing.append(word)
    assert not missing


def exists(folder: Path, path: str) -> bool:
    """Whether there is a file or folder of that name, or of a form such as ``exports/NAME/``."""
    if PLACEHOLDER not in path:
        return (folder / path).exists()
    return any(folder.glob(path.replace(PLACEHOLDER, "*")))


def test_every_page_is_in_the_tree_of_the_site() -> None:
    index = (ROOT / "docs/index.md").read_text("utf-8")
    trees = re.findall(r"^```{toctree}\n(.*?)^```", index, re.MULTILINE | re.DOTALL)
    entries = [line for tree in trees for line in tree.split("\n\n", 1)[1].split()]
    assert sorted(entries) == sorted(set(entries))
    pages = {path.stem for path in DOCS} - {"index"}
    assert not [page for page in pages if not any(fnmatch(page, entry) for entry in entries)]


def test_the_readme_leads_to_the_site_and_its_main_pages() -> None:
    linked = {(ROOT / link.partition("#")[0]).resolve() for link in local_links(ROOT / "README.md")}
    main = ("index", "tutorial", "python", "commands", "design-file", "accuracy", "printability")
    assert {ROOT / f"docs/{name}.md" for name in main} <= linked


def undocumented(names: set[str], page: str) -> set[str]:
    """Names that do not stand in code on a page of the documentation."""
    words = {
        word
        for code in CODE.findall((ROOT / "docs" / page).read_text("utf-8"))
        for word in re.findall(r"-{0,2}[A-Za-z0-9_]+(?:-[A-Za-z0-9_]+)*", code)
    }
    return names - words


def test_every_field_of_a_design_is_documented() -> None:
    fields = {key.rpartition(".")[2] for key in known_keys() if not key.startswith("material.")}
    assert not undocumented(fields, "design-file.md")


def test_every_material_and_every_field_of_one_is_documented() -> None:
    fields = {key.rpartition(".")[2] for key in known_keys() if key.startswith("material.")}
    assert not undocumented(fields | set(material_names()), "materials.md")


def test_every_profile_and_every_field_of_one_is_documented() -> None:
    records = (PrinterProfile, SlicerAdvice, Filament)
    fields = {field for record in records for field in record.model_fields}
    names = {*available_profiles(), *available_filaments()}
    assert not undocumented(fields | names, "printability.md")


def test_every_rule_of_a_printer_is_documented() -> None:
    assert not undocumented(set(RULES), "printability.md")


def test_every_field_of_a_manifest_is_documented() -> None:
    manifest = json.loads((ROOT / "exports/finger/manifest.json").read_text("utf-8"))
    for named_elsewhere in (manifest, manifest["evaluation"]):
        for key in ("design", "files", "printer", "versions"):
            named_elsewhere.pop(key, None)
    assert not undocumented(set(keys_of(manifest)), "json.md")


def keys_of(content: Any) -> Iterator[str]:
    """Names of all fields of a JSON value and of those in it."""
    if isinstance(content, dict):
        yield from content
    for inner in content.values() if isinstance(content, dict) else content:
        if isinstance(inner, dict | list):
            yield from keys_of(inner)


def commands_of(group: Any, before: str = "") -> Iterator[tuple[str, Any]]:
    """All commands by their whole names, those of sub-commands too."""
    for name, command in group.commands.items():
        if hasattr(command, "commands"):
            yield from commands_of(command, f"{before}{name} ")
        else:
            yield f"{before}{name}", command


def test_every_command_and_every_option_is_documented() -> None:
    from typer.main import get_command

    from bellows_design.cli.commands import app

    page = (ROOT / "docs/commands.md").read_text("utf-8")
    commands = dict(commands_of(get_command(app)))
    options = {
        name
        for command in commands.values()
        for parameter in command.params
        for name in parameter.opts
        if name.startswith("--")
    }
    assert "evaluate" in commands and "--accuracy" in options
    assert not [name for name in commands if f"\n## `bellows {name}" not in page]
    assert not undocumented(options, "commands.md")
    lowercase = r"[a-z]+(?: [a-z]+)*"
    headings = re.findall(rf"^## `bellows ({lowercase})", page, re.MULTILINE)
    groups = {name.split()[0] for name in commands}
    assert not [name for name in headings if name not in commands and name not in groups]


def test_the_design_on_the_page_is_one() -> None:
    (block,) = re.findall(
        r"```toml\n(.*?)```", (ROOT / "docs/design-file.md").read_text("utf-8"), re.DOTALL
    )
    assert Design.from_toml(block).name == "my_finger"


def test_the_citation_names_the_packages_version() -> None:
    from bellows_design import __version__

    citation = (ROOT / "CITATION.cff").read_text("utf-8")
    assert re.findall(r"^version: (.+)$", citation, re.MULTILINE) == [__version__]
    assert re.findall(r"^license: (.+)$", citation, re.MULTILINE) == ["MIT"]
    assert "doi: 10.7906/indecs.18.4.8" in citation


NAMED_TEST = re.compile(r"`(tests/[A-Za-z0-9_/.-]+\.py)::(test_\w+)`")


@each_document
def test_every_named_test_exists(document: Path) -> None:
    named = NAMED_TEST.findall(text_of(document))
    missing = [f"{path}::{name}" for path, name in named if f"def {name}(" not in source(path)]
    assert not missing


@cache
def source(path: str) -> str:
    """A file of the tests."""
    return (ROOT / path).read_text("utf-8")
