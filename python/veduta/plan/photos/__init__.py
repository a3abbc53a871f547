"""Photos of rooms: the colour of walls, and tiles of floors and walls."""
