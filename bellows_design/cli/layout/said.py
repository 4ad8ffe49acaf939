"""What goes to stdout as JSON, with the name of its schema, and sentences on errors."""

from __future__ import annotations

import sys
from typing import Any

import typer

from bellows_design.cli.layout.asked import command_asked

ERROR = "error"
"""The schema of what JSON says where there is no answer, and its key."""


def print_error(sentence: str, status: int, as_json: bool) -> None:
    """The sentence on stderr, and where JSON was asked for the same on stdout."""
    typer.echo(f"bellows: {sentence}", err=True)
    if as_json:
        print_json(error_content(sentence, status))


def error_content(sentence: str, status: int) -> dict[str, Any]:
    """What JSON says instead of an answer."""
    return stated({ERROR: sentence, "exit_status": status})


def stated(content: dict[str, Any]) -> dict[str, Any]:
    """The answer of the command that was typed with the name and version of its schema."""
    from bellows_design.schemas.library import label

    return {"schema": label(ERROR if ERROR in content else command_asked()), **content}


def print_json(content: dict[str, Any]) -> None:
    """One object on stdout, in characters that its encoding has."""
    from bellows_design.files.json_files import json_text

    text = json_text(content)
    try:
        text.encode(sys.stdout.encoding)
    except UnicodeEncodeError:
        text = json_text(content, only_ascii=True)
    typer.echo(text, nl=False)
