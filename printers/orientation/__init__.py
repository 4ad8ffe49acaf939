"""How a part stands on the bed: turned as one says, or as prints best."""
