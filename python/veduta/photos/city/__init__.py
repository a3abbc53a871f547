"""A coarse city model: read from files of several formats, as parts in metres."""
