"""From views to an object of a place."""
