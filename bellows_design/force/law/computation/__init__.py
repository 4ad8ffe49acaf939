"""Equilibria of the unit cell for the table, by continuation."""
