"""The best design of a kind, as a front of angle against stress."""
