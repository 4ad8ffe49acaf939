"""Constants of a material law from measured stress over stretch."""
