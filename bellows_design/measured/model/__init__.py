"""The model's curve of what was measured, for every factor on the material's stiffness."""
