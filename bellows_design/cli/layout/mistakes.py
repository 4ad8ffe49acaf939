"""Mistakes in the use of commands and options as sentences, with the names that are near."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

from bellows_design.validation.quoting import did_you_mean, quoted

_CHOICES = re.compile(
    r"(?:^|[\s:])'(?P<value>[^']*)' is not one of (?P<choices>'.*')\.?$", re.DOTALL
)
_NO_COMMAND = re.compile(r"No such command '(?P<name>.*)'\.", re.DOTALL)
_NEEDS_VALUE = re.compile(r"Option '(?P<name>\S+)' requires an argument")
_NO_VALUE = re.compile(r"Option '(?P<name>\S+)' does not take a value")
_EXTRA = re.compile(r"Got unexpected extra arguments?(?:\(s\))? \((?P<words>.*)\)", re.DOTALL)
_NUMBER = re.compile(r"valid (?P<kind>number|integer|float)", re.IGNORECASE)


def sentence_on(error: Any, given: Sequence[str]) -> str:
    """What is wrong with the command line ``given``, and which command explains it."""
    said = _said(error, given)
    context = getattr(error, "ctx", None)
    if context is None:
        return said if said.endswith("?") else f"{said.rstrip('.')}."
    where = " ".join(["bellows", *str(context.command_path).split()[_words_before(context) :]])
    return f"{said if said.endswith('?') else said.rstrip('.') + '.'} See {where} --help."


def _words_before(context: Any) -> int:
    """How many words of its path name the program: ``python -m bellows_design`` has three."""
    root = context.find_root()
    return len(str(root.command_path).split())


def _said(error: Any, given: Sequence[str]) -> str:
    kind, text = type(error).__name__, str(error.format_message())
    context, parameter = getattr(error, "ctx", None), getattr(error, "param", None)
    if kind == "NoSuchOption":
        return f"unknown option {quoted(error.option_name)}{_options_near(error)}"
    if kind == "MissingParameter" and parameter is not None:
        return f"{_name(parameter)} is missing{_choices_of(parameter)}"
    if found := _NO_COMMAND.search(text):
        known = list(getattr(getattr(context, "command", None), "commands", ()))
        return f"unknown command {quoted(found['name'])}{did_you_mean(found['name'], known)}"
    if found := _NEEDS_VALUE.search(text):
        return f"{found['name']} needs a value"
    if found := _NO_VALUE.search(text):
        return f"{found['name']} takes no value"
    if found := _EXTRA.search(text):
        return f"{quoted(found['words'])} is one argument too many"
    if parameter is not None:
        return _bad_value(parameter, text, given)
    return text


def _bad_value(parameter: Any, text: str, given: Sequence[str]) -> str:
    """A value that the parameter does not take."""
    if found := _CHOICES.search(text):
        choices = re.findall(r"'([^']*)'", found["choices"])
        return f"{_name(parameter)} is {quoted(found['value'])}; {_either(choices, found['value'])}"
    value = _value_given(parameter, given)
    shown = "" if value is None else f" is {quoted(value)} but"
    if found := _NUMBER.search(text):
        whole = found["kind"].lower() == "integer"
        return f"{_name(parameter)}{shown} must be a {'whole ' * whole}number"
    return f"{_name(parameter)}{shown} is no value: {text}" if not shown else text


def _either(choices: Sequence[str], value: str) -> str:
    """What a value may be, and of that what is near."""
    import difflib

    near = difflib.get_close_matches(value, choices, n=1)
    hint = f"; did you mean {near[0]}?" if near else ""
    return f"it can be {', '.join(choices[:-1])} or {choices[-1]}{hint}"


def _options_near(error: Any) -> str:
    """The options of the command that look like the unknown one."""
    command = getattr(getattr(error, "ctx", None), "command", None)
    known = [
        name
        for parameter in getattr(command, "params", ())
        for name in (*parameter.opts, *parameter.secondary_opts)
        if name.startswith("--")
    ]
    hint = did_you_mean(str(error.option_name), [*known, "--help"])
    return hint if hint.startswith("; did") else ""


def _name(parameter: Any) -> str:
    """An option as it is typed, an argument as the help calls it."""
    if parameter.param_type_name == "argument":
        return str(parameter.metavar or parameter.name.upper())
    return max(parameter.opts, key=len)


def _choices_of(parameter: Any) -> str:
    """What a missing argument may be, where that are a few words."""
    said = re.findall(r"\t(\S+?),?(?:\n|$)", str(parameter.get_missing_message(None) or ""))
    return f"; it can be {', '.join(said[:-1])} or {said[-1]}" if len(said) > 1 else ""


def _value_given(parameter: Any, given: Sequence[str]) -> str | None:
    """The last value of an option on the command line; None where it does not stand there."""
    found = None
    for word, following in zip(given, [*given[1:], None], strict=True):
        name, equals, value = word.partition("=")
        if name in parameter.opts:
            found = value if equals else following
    return found
