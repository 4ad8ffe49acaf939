"""What the documents show can be pasted: Python runs, files are read, commands are understood."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path
from typing import Any

import pytest
from snippets import ROOT, Snippet, snippets

KINDS = {"python", "toml", "sh", "text", "mermaid", "{toctree}", "json", "xml"}


def named(found: list[Snippet]) -> list[Any]:
    """One test for each snippet, marked as its page says."""
    marks = {True: [pytest.mark.slow], False: []}
    return [pytest.param(each, id=each.name, marks=marks[each.slow]) for each in found]


def test_every_block_says_what_it_is_written_in() -> None:
    opened = re.compile(r"^```(\S*)$", re.MULTILINE)
    for page in {snippet.page for snippet in snippets("python", "toml", "sh", "text", "")}:
        fences = opened.findall((ROOT / page).read_text("utf-8"))[::2]
        assert set(fences) <= KINDS, page


def test_what_does_not_run_has_a_reason() -> None:
    left_out = [each for each in snippets("python", "toml", "sh") if "not run" in str(each.notes)]
    assert all(len(each.reason) > 10 for each in left_out)
    assert len(left_out) < 6


@pytest.mark.parametrize("snippet", named(snippets("python")))
@pytest.mark.thorough
def test_python_runs(snippet: Snippet, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    if snippet.reason:
        pytest.skip(snippet.reason)
    monkeypatch.chdir(tmp_path)
    names: dict[str, Any] = {"__name__": "__main__", "ROOT": ROOT}
    exec(compile(snippet.before, f"before {snippet.name}", "exec"), names)
    exec(compile(snippet.code, snippet.name, "exec"), names)


@pytest.mark.parametrize("snippet", named(snippets("toml")))
def test_a_file_is_read_by_what_it_is_for(
    snippet: Snippet, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    table = tomllib.loads(snippet.code)
    (tmp_path / "file.toml").write_text(snippet.code, "utf-8")
    if "bellows" in table:
        from bellows_design import load_design

        assert load_design("file.toml").name == table["name"]
    elif "parts" in table:
        assert_body(table, tmp_path)
    elif "extends" in table or "nozzle_diameter" in table:
        from printers import load_profile

        assert load_profile("file.toml").name == table["name"]
    elif "yield_strength" in table:
        from bellows_design.materials import Material

        assert Material(**table).yield_strength == table["yield_strength"]
    else:
        groups = table["project"]["entry-points"]
        assert set(groups) <= {"bellows_design.materials", "bellows_design.printers"}


def assert_body(table: dict[str, Any], folder: Path) -> None:
    """The file describes a body, once there are the STEP files that it names."""
    import cadquery as cq

    from bellows_design.own_body import load_body

    bar = cq.Workplane().box(40, 10, 10, centered=False)
    hollow = bar.cut(cq.Workplane().box(30, 4, 4, centered=False).translate((5, 3, 3)))
    for part in table["parts"]:
        cq.exporters.export(hollow, str(folder / part["step"]))
    assert load_body(folder / "file.toml").name == table["name"]


@pytest.mark.parametrize("snippet", named(snippets("sh")))
def test_commands_are_understood(snippet: Snippet) -> None:
    others = {
        "python",
        "python3",
        "apt-get",
        "cq-cli",
        "pip",
        "pytest",
        "dask",
        "sphinx-build",
        "git",
        "cd",
    }
    for words in snippet.commands():
        program, *arguments = words
        name = Path(program).name
        if name == "bellows":
            assert_understood(arguments)
        else:
            assert name in others, words
            paths = [word for word in arguments if word.startswith("examples/")]
            assert all((ROOT / path).exists() for path in paths)


def assert_understood(arguments: list[str]) -> None:
    """The command line knows the command, every option, and the form of its values."""
    from typer.main import get_command

    from bellows_design.cli.commands import app

    command: Any = get_command(app)
    words = list(arguments)
    while hasattr(command, "commands") and words and not words[0].startswith("-"):
        assert words[0] in command.commands, arguments
        command = command.commands[words.pop(0)]
    if hasattr(command, "commands"):
        assert set(words) <= {"--help", "--version", "--install-completion"}, arguments
    else:
        command.make_context(command.name, words)


def test_a_command_that_is_none_is_not_understood() -> None:
    with pytest.raises(AssertionError):
        assert_understood(["evaluat", "finger"])
    with pytest.raises(Exception, match=r"(?i)no such option"):
        assert_understood(["evaluate", "finger", "--accurracy", "2"])


RUN = ("list", "init")
"""Commands of the documents that are run for real with the default tests: they take no time."""


def test_the_quick_commands_of_the_documents_run(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from typer.testing import CliRunner

    from bellows_design.cli.commands import app

    monkeypatch.chdir(tmp_path)
    found = [words for each in snippets("sh") for words in each.commands()]
    quick = {tuple(w[1:]) for w in found if Path(w[0]).name == "bellows" and w[1] in RUN}
    assert len(quick) >= 3
    for words in sorted(quick):
        if words[0] == "init":
            Path(words[2]).unlink(missing_ok=True)  # KIND FILE, options behind it
        done = CliRunner().invoke(app, words)
        assert done.exit_code == 0, done.output
