"""``%load_ext bellows_design.plugin``: notebooks show designs and evaluations in 3D."""

from __future__ import annotations

from typing import Any

from bellows_design.analysis.evaluation import Evaluation
from bellows_design.design.design import Design
from bellows_design.plugin.preview import preview

KINDS: tuple[type, ...] = (Design, Evaluation)


def load_ipython_extension(shell: Any) -> None:
    """Show every design and evaluation by its preview, in this notebook.

    Args:
        shell: IPython's, which calls this for ``%load_ext bellows_design.plugin``.

    Examples:
        >>> from types import SimpleNamespace
        >>> from bellows_design.plugin import load_ipython_extension
        >>> class Formatter(dict):
        ...     for_type = dict.__setitem__
        >>> html = Formatter()  # as IPython has one for each kind of display
        >>> formatter = SimpleNamespace(formatters={"text/html": html})
        >>> load_ipython_extension(SimpleNamespace(display_formatter=formatter))
        >>> print(sorted(kind.__name__ for kind in html))
        ['Design', 'Evaluation']
    """
    html = shell.display_formatter.formatters["text/html"]
    for kind in KINDS:
        html.for_type(kind, _html)


def unload_ipython_extension(shell: Any) -> None:
    """Show them as text again.

    Args:
        shell: IPython's, which calls this for ``%unload_ext bellows_design.plugin``.

    Examples:
        >>> from types import SimpleNamespace
        >>> from bellows_design.plugin import load_ipython_extension, unload_ipython_extension
        >>> class Formatter(dict):
        ...     for_type = dict.__setitem__
        >>> html = Formatter()
        >>> formatter = SimpleNamespace(formatters={"text/html": html})
        >>> shell = SimpleNamespace(display_formatter=formatter)
        >>> load_ipython_extension(shell)
        >>> unload_ipython_extension(shell)
        >>> print(len(html))
        0
    """
    html = shell.display_formatter.formatters["text/html"]
    for kind in KINDS:
        html.pop(kind, None)


def _html(shown: Design | Evaluation) -> str:
    return preview(shown)._repr_html_()
