"""A rock gorge with trees, photographed in stereo along its path, with all of it known."""
