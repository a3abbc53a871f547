"""From photos and their cameras to depth maps."""
