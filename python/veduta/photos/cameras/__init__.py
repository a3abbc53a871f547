"""The kind of camera, the last adjustment, and the way up."""
