"""The report of a design: one HTML file that needs no other, and the same as pictures."""
