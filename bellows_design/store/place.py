"""Where results are kept."""

from __future__ import annotations

import os
from pathlib import Path

from bellows_design.errors import BellowsError
from bellows_design.validation.quoting import quoted

VARIABLE = "BELLOWS_CACHE"
"""Environment variable: another folder than the user's usual one."""


class NoPlace(BellowsError):
    """There is no folder that could be this user's."""


def cache_folder() -> Path:
    """The folder that ``BELLOWS_CACHE`` names, else the one for this user on this system.

    Raises ``NoPlace`` where it depends on a home folder that nobody knows: of a user who is not
    listed, as in many a container, or of one who does not exist (``~name``).
    """
    given = os.environ.get(VARIABLE)
    try:
        return Path(given).expanduser().absolute() if given else _usual()
    except RuntimeError:
        unknown = f"{VARIABLE} is {quoted(given)}, but that" if given else "the user's"
        raise NoPlace(
            f"{unknown} home folder is not known; set {VARIABLE} to a folder for results."
        ) from None


def _usual() -> Path:
    from platformdirs import user_cache_path

    folder = user_cache_path("bellows-design", appauthor=False)
    if not folder.is_absolute():  # ~ that older versions of platformdirs could not resolve
        raise RuntimeError
    return folder
