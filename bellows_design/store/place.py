"""Where results are kept."""

from __future__ import annotations

import os
from pathlib import Path

VARIABLE = "BELLOWS_CACHE"
"""Environment variable: another folder than the user's usual one."""


def cache_folder() -> Path:
    """The folder that ``BELLOWS_CACHE`` names, else the one for this user on this system."""
    given = os.environ.get(VARIABLE)
    if given:
        return Path(given).expanduser().absolute()
    from platformdirs import user_cache_path

    return user_cache_path("bellows-design", appauthor=False)
