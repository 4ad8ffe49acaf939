"""The space of designs: counts, the variables of each, and the air passage."""
