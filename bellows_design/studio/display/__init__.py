"""Shapes and rules that follow from a design's numbers without CAD."""
