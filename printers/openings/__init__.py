"""Mouths of a cavity that nobody declared: where the air inside meets the air outside."""
