"""Lamps of a house: where they hang and stand, so that each point of each room is lit."""
