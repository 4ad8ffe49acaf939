"""A dimensioned sketch of a part: sections of its mesh, true to scale, with the parameters."""
