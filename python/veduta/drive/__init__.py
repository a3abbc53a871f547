"""Street laser scans and images become textured facade meshes without what stood before them.

Frueh, Jain and Zakhor 2005, Data Processing Algorithms for Generating Textured 3D Building Facade
Meshes from Laser Scans and Camera Images.
"""
