"""Hyperelastic laws: their constants, homogeneous states and stability."""
