"""Sparse symmetric systems: patterns, scaling, factorizations."""
