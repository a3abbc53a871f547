"""Paint and tiles of rooms in the house, in IFC and in the document."""

from __future__ import annotations

from dataclasses import fields
from pathlib import Path
from typing import Any

import ifcopenshell
import ifcopenshell.validate
import numpy as np
import pytest
from PIL import Image
from room_photo import RoomScene, Tiled, room_photo
from sample_plan import rectangle, room, sample_plan, sample_storey

from veduta.place.part import Part
from veduta.plan.document import PlanDocument, Room, Tiling, WallColour
from veduta.plan.house.build import House, build_house
from veduta.plan.load import load_document
from veduta.plan.options import HouseOptions
from veduta.plan.outputs.ifc import house_ifc
from veduta.plan.photos.finish import Finished, load_pictures, with_photos
from veduta.plan.photos.given import OPTION, place_of, room_photos
from veduta.plan.photos.look import look_at
from veduta.run.errors import InputError

OCHRE = (201, 162, 90)
TILES = Tiling(surface="wall", picture="tiles-1.png", tiles=(4, 2), size_m=(0.3, 0.2))


def with_room(index: int, **changes: Any) -> PlanDocument:
    storey = sample_storey()
    rooms = list(storey.rooms)
    rooms[index] = rooms[index].model_copy(update=changes)
    return sample_plan(storey.model_copy(update={"rooms": rooms}))


def materials_of(part: Part, name: str) -> set[str]:
    row = part.features.name.index(name)
    return {part.materials[m].name for m in part.polygon_material[part.polygon_feature == row]}


def painted() -> House:
    colour = WallColour(srgb=OCHRE)
    return build_house(with_room(0, wall_colour=colour), HouseOptions())


def test_each_face_of_a_wall_has_the_paint_of_its_own_room() -> None:
    part = painted().part
    assert materials_of(part, "ground floor wall middle in living") == {"paint-c9a25a"}
    assert materials_of(part, "ground floor wall middle in bath") == {"tiled-wall"}
    assert materials_of(part, "ground floor wall west outside") == {"facade"}
    (paint,) = [one for one in part.materials if one.name == "paint-c9a25a"]
    assert tuple(round(255 * one) for one in paint.colour) == OCHRE


def test_tiles_repeat_at_their_size_and_reach_the_model_as_they_are() -> None:
    rng = np.random.default_rng(0)
    picture = rng.integers(0, 255, (40, 120, 3), dtype=np.uint8)
    measured = TILES.model_copy(update={"origin": "measured"})
    document = with_room(1, tilings=[measured])
    part = build_house(document, HouseOptions(), {"tiles-1.png": picture}).part
    row = part.features.name.index("ground floor wall east in bath")
    (number,) = np.unique(part.polygon_material[part.polygon_feature == row])
    texture = part.materials[number].texture
    assert texture is not None
    assert (texture.pixels == picture).all()
    assert not texture.invented.any()
    sizes = np.diff(part.ring_offsets[part.polygon_offsets])
    chosen = np.repeat(part.polygon_feature == row, sizes)
    span_uv, span_m = np.ptp(part.uv[chosen], axis=0), np.ptp(part.positions_m[chosen], axis=0)
    # The picture covers 4 tiles of 0.3 m to the right and 2 of 0.2 m up.
    assert span_uv[0] == pytest.approx(span_m[:2].max() / 1.2, rel=1e-4)
    assert span_uv[1] == pytest.approx(span_m[2] / 0.4, rel=1e-4)


def test_a_picture_that_somebody_wrote_does_not_pass_for_a_photo() -> None:
    picture = np.full((40, 120, 3), 90, dtype=np.uint8)
    pictures = {"tiles-1.png": picture}
    part = build_house(with_room(1, tilings=[TILES]), HouseOptions(), pictures).part
    (texture,) = [
        one.texture for one in part.materials if one.name.startswith("tiles-1") and one.texture
    ]
    assert texture.invented.all()


def test_a_missing_picture_leaves_the_usual_tiles_and_is_told(tmp_path: Path) -> None:
    document = with_room(1, tilings=[TILES])
    loaded = load_pictures(tmp_path, document)
    assert loaded.notes == ("tiles-1.png is missing: its tiles have the usual look",)
    part = build_house(document, HouseOptions(), loaded.pictures).part
    (name,) = materials_of(part, "ground floor wall east in bath")
    (material,) = [one for one in part.materials if one.name == name]
    assert material.texture is None


def test_painted_rooms_have_a_skirting_and_tiled_ones_have_none() -> None:
    tiled = build_house(with_room(0, tilings=[TILES]), HouseOptions()).part
    assert "ground floor skirting living" in painted().part.features.name
    assert "ground floor skirting living" not in tiled.features.name


def test_ifc_has_the_paint_as_a_covering_of_the_space() -> None:
    house = painted()
    model = ifcopenshell.file.from_string(house_ifc(house, HouseOptions()).decode())
    (covering,) = model.by_type("IfcCovering")
    assert (covering.PredefinedType, covering.ObjectType) == ("CLADDING", "paint #c9a25a")
    (relation,) = covering.CoversSpaces
    assert relation.RelatingSpace.LongName == "Living"
    (item,) = covering.Representation.Representations[0].Items
    (style,) = item.StyledByItem[0].Styles
    colour = style.Styles[0].SurfaceColour
    found = [round(255 * part) for part in (colour.Red, colour.Green, colour.Blue)]
    assert tuple(found) == OCHRE
    (faces,) = covering.Representation.Representations[0].Items
    points = np.array(faces.Coordinates.CoordList)
    corners = points[np.array(faces.CoordIndex) - 1]
    area = 0.5 * np.linalg.norm(
        np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1
    )
    width, depth = 4.79, 4.7
    openings = 1.0 * 2.05 + 0.9 * 2.05 + 1.8 * 1.25
    assert area.sum() == pytest.approx(2 * (width + depth) * 2.55 - openings, rel=1e-3)
    log = ifcopenshell.validate.json_logger()  # type: ignore[no-untyped-call]
    ifcopenshell.validate.validate(model, log)
    assert log.statements == []


def test_rooms_are_named_by_id_name_use_and_storey() -> None:
    rooms = [
        room("r1", rectangle(0, 0, 1, 1), name="Küche", use="kitchen"),
        room("r2", rectangle(2, 0, 3, 1), name="Zimmer", use="bedroom"),
        room("r3", rectangle(4, 0, 5, 1), name="Zimmer", use="bedroom"),
    ]
    document = sample_plan(sample_storey(rooms=rooms))
    assert place_of(document, "KÜCHE").room == 0
    assert place_of(document, " R3 ").room == 2
    assert place_of(document, "kitchen").room == 0
    assert place_of(document, "Ground Floor/r2").room == 1
    with pytest.raises(InputError, match=r"may be any of ground floor/r2 .*, ground floor/r3"):
        place_of(document, "Zimmer")
    with pytest.raises(InputError, match=r"no room 'attic'.*r1 \(Küche\), ground floor/r2"):
        place_of(document, "attic")


@pytest.mark.parametrize("given", ["kitchen.jpg", "=a.jpg", "kitchen="])
def test_what_is_not_room_and_file_is_refused(given: str) -> None:
    with pytest.raises(InputError, match="is not ROOM=FILE") as raised:
        room_photos([given])
    assert raised.value.subject == OPTION


def test_photos_that_cannot_be_read_are_named(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="does not exist"):
        room_photos([f"living={tmp_path / 'gone.jpg'}"])
    whole = tmp_path / "whole.png"
    Image.fromarray(room_photo(RoomScene(), 120, 90)).save(whole)
    cut = tmp_path / "cut.png"
    cut.write_bytes(whole.read_bytes()[:5000])
    with pytest.raises(InputError, match="truncated or damaged"):
        room_photos([f"living={cut}"])


def finished(
    tmp_path: Path, scene: RoomScene, name: str, document: PlanDocument | None = None
) -> tuple[Room, Finished]:
    path = tmp_path / "room.png"
    Image.fromarray(room_photo(scene, 600, 450)).save(path)
    before = load_pictures(tmp_path, document or sample_plan())
    done = with_photos(before, room_photos([f"{name}={path}"]))
    place = place_of(done.document, name)
    return done.document.storeys[place.storey].rooms[place.room], done


def test_a_photo_gives_the_room_its_paint_and_floor(tmp_path: Path) -> None:
    scene = RoomScene(floor_tiles=Tiled((0.3, 0.3), joint_m=0.008))
    own, done = finished(tmp_path, scene, "living")
    colour = own.wall_colour
    assert colour is not None
    assert colour.photo is not None
    assert (colour.origin, colour.photo.file) == ("measured", "room.png")
    # The scene dims by 1.2 % a metre: walls are up to 5 m away.
    assert np.abs(np.array(colour.srgb) - np.array(scene.wall)).max() <= 10
    (tiling,) = own.tilings
    assert (tiling.surface, tiling.laid) == ("floor", True)
    assert (tiling.origin, tiling.size_origin) == ("measured", "invented")
    assert tiling.size_m == (0.3, 0.3)
    assert set(done.pictures) == {tiling.picture}
    other = done.document.storeys[0].rooms[1]
    assert (other.wall_colour, other.tilings) == (None, [])
    # It survives being written and read.
    path = tmp_path / "plan.json"
    path.write_text(done.document.model_dump_json(by_alias=True))
    assert load_document(path).storeys[0].rooms[0] == own


def test_a_photo_without_tiles_says_so(tmp_path: Path) -> None:
    own, done = finished(tmp_path, RoomScene(), "living")
    assert own.wall_colour is not None
    assert own.tilings == []
    assert any("no tiles: of" in note for note in done.notes)


FLOOR = RoomScene(floor_tiles=Tiled((0.3, 0.3), joint_m=0.008))


def test_a_missing_picture_keeps_its_name_from_other_rooms(tmp_path: Path) -> None:
    own, done = finished(tmp_path, FLOOR, "living", with_room(1, tilings=[TILES]))
    assert [one.picture for one in own.tilings] == ["tiles-2.png"]
    assert set(done.pictures) == {"tiles-2.png"}
    assert "tiles-1.png is missing: its tiles have the usual look" in done.notes


def test_a_missing_picture_that_a_photo_replaces_is_not_missed(tmp_path: Path) -> None:
    floor = TILES.model_copy(update={"surface": "floor"})
    own, done = finished(tmp_path, FLOOR, "living", with_room(0, tilings=[floor]))
    assert [one.picture for one in own.tilings] == ["tiles-1.png"]
    assert not any("is missing" in note for note in done.notes)


@pytest.mark.parametrize("laid", [True, False])
def test_whether_tiles_are_laid_stays_and_paint_that_they_hide_is_told(
    tmp_path: Path, laid: bool
) -> None:
    scene = RoomScene(wall_tiles=Tiled((0.3, 0.3), joint_m=0.01), pitch_rad=0.05, boxes_m=())
    known = TILES.model_copy(update={"laid": laid})
    own, done = finished(tmp_path, scene, "living", with_room(0, tilings=[known]))
    (tiling,) = own.tilings
    assert (tiling.origin, tiling.laid) == ("measured", laid)
    assert own.wall_colour is not None
    assert any("no wall has it" in note for note in done.notes) == laid
    assert any("are not tiled" in note for note in done.notes) != laid


def test_what_is_seen_in_photos_does_not_hold_them(tmp_path: Path) -> None:
    path = tmp_path / "large.png"
    Image.new("RGB", (3000, 2000), (200, 180, 150)).save(path)
    (photo,) = room_photos([f"living={path}"])
    seen = look_at(photo, sample_storey().rooms[0])
    held = [getattr(seen, one.name) for one in fields(seen)]
    assert sum(one.nbytes for one in held if isinstance(one, np.ndarray)) < 3_000_000
    assert (seen.picture[300, 300] == (200, 180, 150)).all()


@pytest.mark.parametrize(
    ("change", "fault"),
    [
        ({"tilings": [{**TILES.model_dump(), "size_m": (0.0, 0.3)}]}, r"tilings\[0\].size_m"),
        ({"tilings": [TILES.model_dump()] * 2}, "has tiles already"),
        ({"tilings": [{**TILES.model_dump(), "picture": "../x.png"}]}, r"tilings\[0\].picture"),
        ({"wall_colour": {"srgb": (0, 0, 256)}}, r"wall_colour.srgb\[2\]"),
    ],
)
def test_faulty_finishes_are_named(tmp_path: Path, change: dict[str, Any], fault: str) -> None:
    own = sample_storey().rooms[0].model_dump() | change
    rooms = [Room.model_construct(**own), sample_storey().rooms[1]]
    storey = sample_storey().model_copy(update={"rooms": rooms})
    path = tmp_path / "plan.json"
    path.write_text(sample_plan(storey).model_dump_json(by_alias=True, warnings=False))
    with pytest.raises(InputError, match=fault):
        load_document(path)
