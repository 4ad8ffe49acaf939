"""The sections of a report, one module each: from findings to blocks."""
