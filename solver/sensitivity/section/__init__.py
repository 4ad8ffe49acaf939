"""How a section answers to the loads on it: by the tangent of an equilibrium."""
