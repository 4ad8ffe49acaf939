"""A printer's profile as settings of a slicer, and the slicer that makes G-code with them."""
