"""Case A: silicone bending actuators with a film."""
