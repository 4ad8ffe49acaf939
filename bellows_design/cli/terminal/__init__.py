"""What is printed for people: as wide as the terminal, in colours where these are wanted."""
