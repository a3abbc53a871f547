"""Sound documents and rules of each kind, and lots of other formats, for `faulty_inputs`."""

from __future__ import annotations

import json
import sys
import zipfile
from pathlib import Path

import sets_of_cameras as sets
from faulty_records import Kind, cameras_file, lots_file, text_file

from veduta.cameras import read_cameras
from veduta.drive.document import load as drive_files
from veduta.drive.document.model import DriveDocument, DriveSegment, PathPose
from veduta.fauna.document.load import load_animal, save_animal
from veduta.grammar.edits import read_edits
from veduta.grammar.lots import read_lots
from veduta.grammar.rule_packages import unpacked
from veduta.grammar.rules import check_rules, read_rules
from veduta.photos.intake.rig import read_rig_file
from veduta.photos.world.control_file import read_control
from veduta.photos.world.position_file import read_positions
from veduta.walk.document.load import read_document
from veduta.walk.document.schema import KeyRecord, RigRecord, TransitionRecord, WalkDocument

sys.path.append(str(Path(__file__).parents[1] / "fauna"))
from swimming import sample_animal
from walking import walking_limbed

_STILL = (1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0)
_RULES = """version "2021.0"
import parts : "parts.cga"
attr height = 9
@StartRule
Lot --> extrude(height) comp(f) { top : Roof | side : split(y) { ~3 : Floor }* }
Floor --> split(x) { 1 : Wall | { ~2 : parts.Window }* | 1 : Wall }
Roof --> roofHip(30, 0.4) color("#884422")
"""
_PARTS = "Window --> case scope.sx > 1 : 50% : color(1, 0, 0) else : NIL else : X.\n"
_EDITS = "lot-1 /0/2:Floor delete\n# a wall\nlot-2 /0/1 height = 3.5\nlot-2 /0 choice 1 = 2\n"
_CONTROL = """EPSG:25832
500000.0 5000000.0 80.0 412.5 300.25 a.jpg corner
500004.0 5000001.0 80.0 9 8 b.jpg
"""
_POSITIONS = "EPSG:4326\na.jpg 7.1 50.7 80.0\nb.jpg 7.1001 50.7001\n"
_OSM = """<?xml version='1.0' encoding='UTF-8'?>
<osm version="0.6"><node id="1" lat="50.7" lon="7.1"/><node id="2" lat="50.7001" lon="7.1"/>
<node id="3" lat="50.7001" lon="7.1002"/><node id="4" lat="50.7" lon="7.1002"/>
<way id="9"><nd ref="1"/><nd ref="2"/><nd ref="3"/><nd ref="4"/><nd ref="1"/>
<tag k="building" v="yes"/><tag k="building:levels" v="3"/></way></osm>
"""
_KML = """<?xml version="1.0" encoding="UTF-8"?>
<kml xmlns="http://www.opengis.net/kml/2.2"><Document><Placemark><name>lot</name><Polygon>
<outerBoundaryIs><LinearRing><coordinates>7.1,50.7,0 7.1002,50.7,0 7.1002,50.7001,0 7.1,50.7,0
</coordinates></LinearRing></outerBoundaryIs></Polygon></Placemark></Document></kml>
"""


def _animal(folder: Path) -> Path:
    save_animal(sample_animal(), folder / "animal.json")
    return folder / "animal.json"


def _limbed(folder: Path) -> Path:
    save_animal(walking_limbed(), folder / "animal.json")
    return folder / "animal.json"


def _drive(folder: Path) -> Path:
    poses = [PathPose(sweep=f"s{n}", time_s=0.1 * n, matrix=_STILL[:12]) for n in range(5)]
    line = [(0.0, 0.0, 1.0), (4.0, 0.0, 1.0), (8.0, 0.1, 1.0)]
    segment = DriveSegment(id="left-001", side="left", line=line, reason="the record's end")
    document = DriveDocument(
        record="log", path_from="given poses", path=poses, segments=[segment], notes=["a note"]
    )
    return text_file("drive.json", document.model_dump_json(by_alias=True, indent=1))(folder)


def _walk(folder: Path) -> Path:
    rig = RigRecord(
        width_px=640, height_px=480, focal_px=(420.0, 420.0), centre_px=(320.0, 240.0),
        centre_right_px=320.0, baseline_m=0.12,
    )  # fmt: skip
    keys = [KeyRecord(id=name, left=name, right=name, transform=_STILL) for name in "ab"]
    way = TransitionRecord(
        start="a", end="b", kind="morph", distance_m=2.0, forth="walk/a.glb", back="walk/b.glb"
    )
    document = WalkDocument(rig=rig, keys=keys, transitions=[way])
    return text_file("walk.json", document.model_dump_json(by_alias=True, indent=1))(folder)


def _package(folder: Path) -> Path:
    with zipfile.ZipFile(folder / "town.rpk", "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("rules/town.cga", _RULES)
        archive.writestr("rules/parts.cga", _PARTS)
    return folder / "town.rpk"


def _rules(folder: Path) -> Path:
    (folder / "parts.cga").write_text(_PARTS, "utf-8")
    return text_file("town.cga", _RULES)(folder)


def _checked(path: Path) -> object:
    """As `veduta grammar check` does it: faults of the text are listed, not raised."""
    return check_rules(read_rules(path))


def _rig(folder: Path) -> Path:
    turned = {"cam_from_rig_rotation": [1.0, 0.0, 0.0, 0.0]}
    cameras = [
        {"image_prefix": "front", "ref_sensor": True},
        {"image_prefix": "left", **turned, "cam_from_rig_translation": [0.4, 0.0, 0.0]},
    ]
    return text_file("rig_config.json", json.dumps([{"cameras": cameras}]))(folder)


def _of_folder(path: Path) -> object:
    return read_cameras(path.parent)


DOCUMENTS: dict[str, Kind] = {
    "animal.json": (_animal, load_animal),
    "animal.json with limbs": (_limbed, load_animal),
    "drive.json": (_drive, drive_files.load_document),
    "walk.json": (_walk, read_document),
    "rule package": (_package, lambda path: _checked(unpacked(path))),
    "rule file": (_rules, _checked),
    "edits": (text_file("town.edits", _EDITS), read_edits),
    "OSM lots": (text_file("lots.osm", _OSM), read_lots),
    "KML lots": (text_file("lots.kml", _KML), read_lots),
    "FlatGeobuf lots": (lots_file(".fgb", "FlatGeobuf"), read_lots),
    "control points": (text_file("control.txt", _CONTROL), read_control),
    "positions": (text_file("geo.txt", _POSITIONS), read_positions),
    "rig": (_rig, lambda path: read_rig_file(path, "", ["front", "left"])),
    "Strecha": (cameras_file(f"{sets.ring()[0].name}.camera", sets.write_strecha), _of_folder),
    "Middlebury": (cameras_file("ring_par.txt", sets.write_middlebury), _of_folder),
}
