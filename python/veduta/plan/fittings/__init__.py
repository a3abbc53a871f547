"""Things that a plan draws in its rooms: baths, toilets, basins, showers, hobs, sinks and beds."""
