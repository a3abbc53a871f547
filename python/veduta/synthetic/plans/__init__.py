"""House plans with known truth: laid out by a seed, drawn in many styles, and scanned badly."""
