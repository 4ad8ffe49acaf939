"""Many designs around one: which, in which order, and what is found for them."""
