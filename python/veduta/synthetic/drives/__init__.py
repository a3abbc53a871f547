"""Drives along streets with known truth: scans and images as a truck would record them."""

from veduta.synthetic.drives.drive_photos import Taken, take_photos, write_photos
from veduta.synthetic.drives.fronts import Fronts
from veduta.synthetic.drives.level_scan import LevelScanner, scan_level
from veduta.synthetic.drives.photograph import StreetCamera, StreetPhoto, photograph
from veduta.synthetic.drives.scan import DriveScans, TruckOptions, poses_at, scan_street
from veduta.synthetic.drives.street import Kind, Street, StreetOptions, build_street
from veduta.synthetic.drives.write import write_drive

__all__ = [
    "DriveScans", "Fronts", "Kind", "LevelScanner", "Street", "StreetCamera", "StreetOptions",
    "StreetPhoto", "Taken", "TruckOptions", "build_street", "photograph", "poses_at", "scan_level",
    "scan_street", "take_photos", "write_drive", "write_photos",
]  # fmt: skip
