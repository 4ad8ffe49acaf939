"""3MF: a ZIP archive of XML."""
