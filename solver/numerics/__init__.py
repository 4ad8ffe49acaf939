"""How functions are compiled and cached, and special functions."""
