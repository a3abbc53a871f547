"""Frames, transforms and polygons: pure geometry without images."""
