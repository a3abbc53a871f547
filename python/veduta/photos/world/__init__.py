"""Where a component lies in the world: by control points, a city model, or GPS."""
