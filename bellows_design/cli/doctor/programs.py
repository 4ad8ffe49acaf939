"""Other programs: the slicer, a browser, and pictures without a screen."""

from __future__ import annotations

import os
import shutil
import webbrowser
from collections.abc import Mapping

from bellows_design.cli.doctor.finding import Finding
from bellows_design.cli.doctor.libraries import how_to_mend
from bellows_design.cli.doctor.trying import Tried

GROUP = "programs"

BROWSERS = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "msedge")
"""Those that draw a page without a window."""


def slicer() -> Finding:
    """Without one there is no leak test."""
    from printers.errors import PrintersError
    from printers.slicing.finding import VARIABLE, find_slicer

    mend = f"install PrusaSlicer (Debian: prusa-slicer), or name its program in {VARIABLE}"
    try:
        found = find_slicer()
    except PrintersError as error:
        return Finding(GROUP, "slicer", "warn", str(error), mend)
    if found is None:
        said = "there is none: leak tests are left out"
        return Finding(GROUP, "slicer", "warn", said, mend)
    return Finding(GROUP, "slicer", "ok", f"{found.name} {found.version}, {found.path}")


def browser() -> Finding:
    """The studio and reports are looked at in one; Chromium makes pictures of reports."""
    headless = next((path for name in BROWSERS if (path := shutil.which(name))), None)
    if headless is not None:
        return Finding(GROUP, "browser", "ok", headless)
    mend = "install Chromium (Debian: chromium)"
    try:
        usual = webbrowser.get()
    except webbrowser.Error:
        said = "there is none here: open pages of the studio and reports elsewhere"
        return Finding(GROUP, "browser", "warn", said, mend)
    said = f"{getattr(usual, 'name', 'the usual one')}, but no Chromium for pictures of reports"
    return Finding(GROUP, "browser", "warn", said, mend)


def display(tried: Mapping[str, Tried]) -> Finding:
    """VTK draws without a screen: the thickness of walls and the like as pictures."""
    probe = tried.get("display", Tried())
    said = dict(probe.said.get("pyvista", {}))
    if said.get("works"):
        return Finding(GROUP, "pictures by VTK", "ok", "drawn without a screen")
    error = str(said.get("error") or "; ".join(probe.broken.values()) or "the picture is empty")
    mend = how_to_mend(error, "pyvista")
    if "No module named" in error:
        mend = "pip install -e '.[pictures]'"
    elif "signal" in error or not said:
        mend = "install an OpenGL library (Debian: libgl1 libegl1 libosmesa6)"
    return Finding(GROUP, "pictures by VTK", "warn", " ".join(error.split())[:200], mend)


def shell_completion() -> Finding:
    """Whether the shell completes this program's words."""
    shell = os.path.basename(os.environ.get("SHELL", ""))
    if shell not in _SCRIPTS:
        return Finding(GROUP, "completion", "ok", f"none for the shell {shell or 'that is used'}")
    file = os.path.expanduser(_SCRIPTS[shell])
    if os.path.exists(file):
        return Finding(GROUP, "completion", "ok", f"{shell}, {file}")
    said = f"not installed for {shell}"
    return Finding(GROUP, "completion", "ok", said, "bellows --install-completion")


_SCRIPTS: Mapping[str, str] = {
    "bash": "~/.bash_completions/bellows.sh",
    "zsh": "~/.zfunc/_bellows",
    "fish": "~/.config/fish/completions/bellows.fish",
}
"""Where completions of a shell are installed."""
