"""What surrounds a command: its streams, its environment, the limits of its process."""
