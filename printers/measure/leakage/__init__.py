"""Where a cavity that does not close is open."""
