"""Walls as a graph of centre lines with thickness, from the ink of a cleaned sheet."""
