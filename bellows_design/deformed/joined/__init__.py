"""Copies and pieces of solved bodies as one: mirrored, cut, placed end to end."""
