"""Speed against error, measured on this machine against stored reference values."""
