"""Sizes of the next mesh's elements, and interpolation of a solution to it."""
