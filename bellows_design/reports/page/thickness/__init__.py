"""How thick the material is below every point of a part's surface, for colours on it."""
