"""Files: JSON and TOML, written completely or not at all, and read with guards."""
