"""The texture of any triangle mesh from photos that see it."""
