"""The next mesh: where it must be finer, and what it starts from."""
