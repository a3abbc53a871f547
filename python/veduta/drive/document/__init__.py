"""`drive.json`."""
