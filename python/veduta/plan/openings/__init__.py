"""Doors, windows and gaps: where walls are interrupted, and by what drawing."""
