"""A lab's measurements of its part against the model: bands, and a factor on the stiffness."""
