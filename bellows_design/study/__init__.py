"""Designs of the literature, to be computed again."""
