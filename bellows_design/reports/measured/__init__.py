"""A comparison with measurements, as values, text and picture."""
