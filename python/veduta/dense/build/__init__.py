"""From depth maps to a cloud, a mesh and a place."""
