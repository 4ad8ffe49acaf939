"""Equilibrium paths: Newton's method, load steps, arc length, volume control."""
