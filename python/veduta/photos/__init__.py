"""The verb `veduta photos`: a folder of ordinary photos becomes calibrated cameras and points."""

# Pillow is loaded before pycolmap: both bring zlib's functions, and where pycolmap's are found
# first (Pillow 13.0, pycolmap 4.2.1) writing a PNG corrupts the heap.
import PIL.Image  # noqa: F401
