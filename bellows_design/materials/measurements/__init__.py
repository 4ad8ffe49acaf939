"""Measured stress over stretch: read from what test machines write, with a record of how."""
