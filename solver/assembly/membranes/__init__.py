"""Membranes on surfaces: their strain, stiffness, and forces."""
