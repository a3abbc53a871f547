"""Drives along streets with known truth: scans and images as a truck would record them."""

from veduta.synthetic.drives.drive_photos import Taken, take_photos, write_photos
from veduta.synthetic.drives.fronts import Fronts
from veduta.synthetic.drives.houses import HouseMaker, MadeHouse, generated_house
from veduta.synthetic.drives.level_scan import LevelScanner, scan_level
from veduta.synthetic.drives.made_photos import overcast, photograph_made
from veduta.synthetic.drives.made_street import MadeStreet, MadeStreetOptions, make_street
from veduta.synthetic.drives.photograph import StreetCamera, StreetPhoto, photograph
from veduta.synthetic.drives.scan import PAPER, DriveScans, TruckOptions, poses_at, scan_street
from veduta.synthetic.drives.scenery import Scenery
from veduta.synthetic.drives.street import Kind, Street, StreetOptions, build_street
from veduta.synthetic.drives.way import Way
from veduta.synthetic.drives.write import write_drive

__all__ = [
    "PAPER", "DriveScans", "Fronts", "HouseMaker", "Kind", "LevelScanner", "MadeHouse",
    "MadeStreet", "MadeStreetOptions", "Scenery", "Street", "StreetCamera", "StreetOptions",
    "StreetPhoto", "Taken", "TruckOptions", "Way", "build_street", "generated_house", "make_street",
    "overcast", "photograph", "photograph_made", "poses_at", "scan_level", "scan_street",
    "take_photos", "write_drive", "write_photos",
]  # fmt: skip
