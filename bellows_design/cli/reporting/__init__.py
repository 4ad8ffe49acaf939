"""``bellows report``: its options and its answer."""
