"""Equilibrium paths: load steps, arc length, volume control."""
