"""The boundary value problem: mesh, material, supports and loads."""
