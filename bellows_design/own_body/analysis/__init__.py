"""An own body under its load: its mesh and problem, the solve, and what the solutions say."""
