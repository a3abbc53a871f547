"""Reading images, EXIF, line segments, and what the directions of a scene say about a camera."""
