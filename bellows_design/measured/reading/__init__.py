"""From a file to a measured curve of angle, displacement or force over pressure."""
