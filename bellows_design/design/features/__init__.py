"""What may be added to the bellows: a mount at the root, a fingertip at the tip."""
