"""A design under pressure: models, meshes, solutions, and what they say of the whole actuator."""
