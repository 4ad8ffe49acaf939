"""Records as TOML files that people write: found by name or path, read with care, inherited."""
