"""The path of an animal: over a terrain, clear of obstacles, smooth (paper 4.3)."""
