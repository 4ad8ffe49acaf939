"""Volume control: equilibria at given volumes, and what happens between them."""
