"""Upright rectangles in the points, and a metric picture of each."""
