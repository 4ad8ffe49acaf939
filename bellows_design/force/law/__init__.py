"""How half a bubble turns and stretches under pressure and section loads, as a table."""
