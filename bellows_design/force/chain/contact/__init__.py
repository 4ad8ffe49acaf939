"""Rigid objects, and what they exert on points that touch them."""
