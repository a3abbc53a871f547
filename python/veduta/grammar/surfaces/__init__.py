"""Textures made by code, of known sizes in metres: walls, roofs, grounds, wood."""
