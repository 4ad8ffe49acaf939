"""``bellows studio``: its options and its answer."""
