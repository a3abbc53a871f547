"""Drives along streets with known truth: scans as a truck with 2D scanners would record them."""

from veduta.synthetic.drives.level_scan import LevelScanner, scan_level
from veduta.synthetic.drives.scan import DriveScans, TruckOptions, scan_street
from veduta.synthetic.drives.street import Kind, Street, StreetOptions, build_street
from veduta.synthetic.drives.write import write_drive

__all__ = [
    "DriveScans", "Kind", "LevelScanner", "Street", "StreetOptions", "TruckOptions", "build_street",
    "scan_level", "scan_street", "write_drive",
]  # fmt: skip
