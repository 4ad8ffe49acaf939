"""The finger: rigid stubs, pieces that obey a law, and where their points are as they move."""
