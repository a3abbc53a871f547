"""From matches to poses and points, and which matches are doubted."""
