"""Streets with known truth: where houses stand, where people walk, and what their photos show."""
