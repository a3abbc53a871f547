"""The faces of a city model, textured from the photos that lie in it."""
