"""What the studio's processes compute, each from plain values to plain values and arrays."""
