"""How a design's results depend on its numbers: locally, over a box, and within tolerances."""
