"""``bellows compare``: its options and its answer."""
