"""Furniture: a catalogue of objects, what they look like, and where they stand in a house."""
