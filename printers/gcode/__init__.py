"""G-code of a slicer, read as the beads of plastic that it lays down."""
