"""What lies around a house: ground of several materials, on a slope if asked for, and plants."""
