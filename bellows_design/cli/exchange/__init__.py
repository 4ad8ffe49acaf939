"""``bellows mesh``: the body of a design for other programs."""
