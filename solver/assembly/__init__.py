"""Residual and tangent of a problem at a state."""
