"""``bellows doctor``: whether everything that is needed is there and works, and how to mend it."""
