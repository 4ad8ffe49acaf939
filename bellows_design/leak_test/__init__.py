"""The leak test on a slicer's G-code: its record, and the slicer of this machine."""
