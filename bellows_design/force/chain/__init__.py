"""A planar chain of half bubbles between two stubs, and its equilibrium among loads and objects."""
