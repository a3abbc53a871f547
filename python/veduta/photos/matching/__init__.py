"""Which photos show the same things: features, pairs, matches, two views."""
