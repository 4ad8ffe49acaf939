"""Designs near to one that was evaluated: their equilibria by continuation, and sensitivities."""
