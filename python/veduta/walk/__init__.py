"""Stereo views along a path become a walk on which geometry and texture morph from view to view."""
