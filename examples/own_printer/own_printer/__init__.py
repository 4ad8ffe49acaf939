"""Printer profiles: the TOML files of this package, each known by its file's name."""
