"""Meshes and problems as files of other programs, and meshes from such files."""
