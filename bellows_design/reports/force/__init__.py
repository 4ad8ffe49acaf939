"""What a finger exerts: tables, curves and pictures for people."""
