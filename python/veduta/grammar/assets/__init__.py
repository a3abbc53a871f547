"""Ready-made geometry for rule files: windows, railings, cornices, dormers, and files of users."""
