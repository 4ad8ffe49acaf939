"""Parts as files, and the folder of an approved design."""
