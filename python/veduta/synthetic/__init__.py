"""Places with known truth, rendered as photos, scans and plans."""
