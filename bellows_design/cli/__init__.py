"""The command ``bellows``: what it reads, how it answers, and how it ends."""
