"""Many designs: questions, their answers as plain rows, and who works on them."""
