"""What each command of ``bellows study`` does: from its options to its answer."""
