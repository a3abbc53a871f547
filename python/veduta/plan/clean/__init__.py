"""A sheet laid straight, with its ink told from its paper."""
