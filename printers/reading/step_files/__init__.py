"""STEP, by the CAD kernel, in a process of its own."""
