"""Distances to a triangle surface, exactly."""
