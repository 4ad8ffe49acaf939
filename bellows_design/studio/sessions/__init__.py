"""What is computed for each open page, and in what order."""
