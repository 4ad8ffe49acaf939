"""What stands around an actuator when its force is asked for: scenes, as data."""
