"""How thick the material is, everywhere on a surface."""
