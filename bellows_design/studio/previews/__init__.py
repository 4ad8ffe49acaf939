"""Angle and stress of a design before its ordinary evaluation, with honest errors."""
