"""How narrow the ways are that air must take through a cavity."""
