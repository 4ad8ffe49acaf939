"""What is measured on a triangle mesh: walls, gaps, shells, leaks."""
