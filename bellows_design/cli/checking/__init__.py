"""The command ``bellows check``: a design, a part of any program, or G-code, by the same rules."""
