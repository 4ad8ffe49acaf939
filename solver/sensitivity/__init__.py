"""Exact derivatives of an equilibrium's responses, by the adjoint method."""
