"""The factor on the stiffness that a measured curve tells, its interval, and what it leaves."""
