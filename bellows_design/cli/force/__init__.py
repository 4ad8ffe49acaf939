"""``bellows force``: its options and its answer."""
