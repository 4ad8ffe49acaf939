"""From a file to named columns of cells: encodings, separators, decimal signs, headers, units."""
