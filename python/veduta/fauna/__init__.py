"""Footage of an animal becomes a living 3D animal in the place (`veduta fauna`)."""
