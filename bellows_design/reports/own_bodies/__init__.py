"""Reports on bodies of one's own."""
