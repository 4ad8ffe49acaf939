"""A mesh of one design as a mesh of a neighbouring one: same tetrahedra, moved nodes."""
