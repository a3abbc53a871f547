"""Rooms: the spaces that walls and openings close."""
