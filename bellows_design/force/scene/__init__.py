"""A finger in its scene: what surrounds it, its equilibria, and what is read of them."""
