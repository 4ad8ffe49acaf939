"""The documentation's site: ``sphinx-build -W --keep-going -b html docs OUTPUT``.

The pages of this folder are the site's as they are. What follows from the code (commands, fields of
files, names of the Python API, the gallery) is written to ``docs/generated`` at every build and is
not committed. Nothing is loaded from elsewhere, neither while it is built nor while it is read.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

HERE = Path(__file__).parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

from bellows_design import __version__  # noqa: E402
from generators.links import with_pages_that_are_there, within_the_site  # noqa: E402
from generators.pages import write_pages  # noqa: E402

project = "bellows-design"
author = "bellows-design contributors"
project_copyright = author
release = version = __version__
language = "en"

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "sphinx.ext.viewcode",
    "sphinx_copybutton",
    "sphinx_design",
]
source_suffix = {".md": "markdown", ".rst": "restructuredtext"}
exclude_patterns = ["generators"]
smartquotes_action = "qe"  # quotes and ellipses: options keep their two hyphens
default_role = "code"  # docstrings have names between single or double backticks

myst_heading_anchors = 4
myst_enable_extensions = ["attrs_block", "colon_fence"]

napoleon_use_ivar = True  # attributes are a list, not entries of their own
napoleon_use_rtype = False
autodoc_typehints = "none"  # signatures have the types already where they are short
autodoc_member_order = "bysource"
autodoc_default_options = {"exclude-members": "model_config, model_fields, model_computed_fields"}
python_maximum_signature_line_length = 88

html_theme = "furo"
html_title = "bellows-design"
html_show_sphinx = False
html_copy_source = False
html_theme_options = {"navigation_with_keys": True}
copybutton_exclude = ".linenos, .gp, .go"
"""Prompts and answers of an example are not copied, so that it can be pasted."""

TYPES = {
    r"numpy\.ndarray\[tuple\[Any, \.\.\.\], numpy\.dtype\[numpy\.float64\]\]": "array of floats",
    r"numpy\.ndarray\[tuple\[Any, \.\.\.\], numpy\.dtype\[numpy\.int(?:32|64)\]\]": "array of ints",
    r"\b(?:collections\.abc|typing)\.": "",
}


WORDS = {" -- ": " – ", "Variables": "Attributes"}


def setup(app):  # type: ignore[no-untyped-def]
    """Pages are generated before Sphinx looks for them; links are led within the site."""
    app.connect("builder-inited", lambda app: write_pages(HERE / "generated"), priority=100)
    app.connect("source-read", read)
    app.connect("autodoc-skip-member", skipped)
    app.connect("autodoc-process-docstring", shortened, priority=900)  # after napoleon
    app.connect("doctree-read", reworded)


def read(app, name, source):  # type: ignore[no-untyped-def]
    """A page of the forge as one of the site."""
    if Path(app.env.doc2path(name)).suffix == ".md":
        folder = (HERE / name).parent
        source[0] = within_the_site(with_pages_that_are_there(source[0], folder), folder, folder)


def shortened(app, what, name, member, options, lines):  # type: ignore[no-untyped-def]
    """Types of attributes without the whole names of NumPy's arrays."""
    for long, short in TYPES.items():
        lines[:] = [re.sub(long, short, line) for line in lines]


def reworded(app, doctree):  # type: ignore[no-untyped-def]
    """Pieces of text that Sphinx writes into descriptions, as they are written elsewhere."""
    for node in list(doctree.findall()):
        if not node.children and node.astext() in WORDS:
            node.parent.replace(node, type(node)(WORDS[node.astext()]))


def skipped(app, kind, name, member, skip, options):  # type: ignore[no-untyped-def]
    """Of the members of a class only methods and properties are entries of their own."""
    import pydantic

    described = callable(member) or isinstance(member, property | classmethod | staticmethod)
    inherited = getattr(pydantic.BaseModel, name, None) is not None
    return skip or not described or inherited
