"""Which indent in the bottom wall does what: searched for, not assumed."""
