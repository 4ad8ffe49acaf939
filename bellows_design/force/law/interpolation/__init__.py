"""The law between computed equilibria: one potential of pressure and section loads."""
