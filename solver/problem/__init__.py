"""What is to be solved: a mesh, its material, supports and loads."""
