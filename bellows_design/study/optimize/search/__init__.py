"""Ways to look for the best design: over all choices, and by gradients within one."""
