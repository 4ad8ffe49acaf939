"""``bellows mesh`` and ``bellows plate``: designs for other programs, and several in one file."""
