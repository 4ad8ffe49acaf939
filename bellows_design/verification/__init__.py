"""Whether an export is as it was written, holds its part, and would be approved again."""
