"""Files to start from, and what there is to name in them."""
