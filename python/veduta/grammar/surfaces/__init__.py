"""Textures made by code, of known sizes in metres: what the walls and roofs of rule files look like."""
