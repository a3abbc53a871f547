"""From a folder of stereo pictures to rectified pairs."""
