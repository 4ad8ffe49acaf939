"""What is read of membranes in an equilibrium."""
