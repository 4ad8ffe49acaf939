"""Newton's method at one load."""
