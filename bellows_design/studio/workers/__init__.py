"""Processes that compute for the studio, and what gives them work."""
