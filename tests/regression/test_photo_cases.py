"""Photos that people who did not build this brought: `cases/photos`, each as its INDEX says.

Not here: gcp/neg_px (a unit test of marks outside of their photos), gcp/swapped_latlon (one mark of
one point: nothing contradicts it), and the drone survey, whose photos are not among the cases; a
painted village stands for it (`benchmarks/photos/photos_nadir.py`).
"""

from __future__ import annotations

import json
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pycolmap
import pytest
from PIL import Image
from pyproj import Transformer

from veduta.imaging.read import read_image
from veduta.imaging.shot import Position
from veduta.photos.cameras.component import Component
from veduta.photos.city.model import CityModel
from veduta.photos.city.reading import read_city_model
from veduta.photos.finding import finish_components
from veduta.photos.intake.call import plan_call
from veduta.photos.intake.from_colmap import given_model
from veduta.photos.intake.given import Given
from veduta.photos.intake.read import PhotoRecord, read_photos, sizes_of
from veduta.photos.options import CameraOptions, ModelOptions, PhotosOptions, WallOptions
from veduta.photos.structure import Structure, structure_of, without_parallel
from veduta.photos.walls.find_walls import find_walls
from veduta.photos.walls.level_edges import turned_to_edges
from veduta.photos.walls.step import segments_by_photo, set_upright
from veduta.photos.walls.wall import Wall
from veduta.photos.world.control_axes import settled_axes
from veduta.photos.world.control_file import read_control
from veduta.photos.world.control_fit import control_georeference
from veduta.photos.world.control_marks import marks_within
from veduta.photos.world.georeference import Georeference
from veduta.photos.world.georeferencing import References, georeference
from veduta.run.errors import InputError

pytestmark = pytest.mark.regression


@pytest.fixture(scope="module")
def cases(veduta_data: Path) -> Path:
    folder = veduta_data / "cases" / "photos"
    if not folder.is_dir():
        pytest.skip(f"no cases/photos in {veduta_data}")
    return folder


@pytest.fixture(scope="module")
def fountain(cases: Path) -> Structure:
    call = plan_call(cases / "fountain7", Given(from_colmap=cases / "fountain7_sparse"))
    return given_model(call.models, read_photos(call.sources).photos).components[0].structure


def test_photos_that_are_not_read_are_named(cases: Path) -> None:
    call = plan_call(cases / "heic_mixed")
    names = {name for name, _ in call.unread} | {source.name for source in call.sources}
    assert names == {path.name for path in (cases / "heic_mixed").iterdir()}
    heic = [source.path for source in call.sources if source.name.endswith(".HEIC")]
    assert len(heic) == 3
    for path in heic:
        assert min(read_image(path).pixels.shape[:2]) > 100


def test_twelve_bits_in_sixteen_are_not_black(cases: Path) -> None:
    for path in sorted((cases / "tiff16_dark").iterdir()):
        photo = read_image(path)
        assert 60 < float(np.median(photo.pixels)) < 180
        assert "use 12 bits" in photo.notes[0]


def test_marks_made_on_larger_photos(cases: Path) -> None:
    sizes = sizes_of(plan_call(cases / "fountain7").sources)
    with pytest.raises(InputError, match=r"24 of its 24 marks outside.*900 x 600 px"):
        marks_within(read_control(cases / "gcp" / "f_fullres.txt"), sizes)


def test_degrees_in_a_metric_crs(cases: Path) -> None:
    for name in ("f_deg_in_utm", "utm_outside"):
        with pytest.raises(InputError, match="looks like degrees"):
            read_control(cases / "gcp" / f"{name}.txt")


@pytest.mark.parametrize("name", ["f_bad1", "f_bad1_minus_g3"])
def test_the_wrong_point_is_named(cases: Path, fountain: Structure, name: str) -> None:
    found = control_georeference(fountain, read_control(cases / "gcp" / f"{name}.txt"))
    assert found.accepted
    assert "g0 is left out: it lies 3.0" in found.why
    assert found.best is not None
    assert found.best.rms_m < 0.005


@pytest.mark.parametrize("name", ["f_good", "f_wgs", "f_bad1_minus_g0"])
def test_points_that_agree_are_all_kept(cases: Path, fountain: Structure, name: str) -> None:
    """The last has all but the wrong one."""
    control, _ = settled_axes(fountain, read_control(cases / "gcp" / f"{name}.txt"))
    found = control_georeference(fountain, control)
    assert found.accepted, found.why
    assert "left out" not in found.why
    assert found.best is not None
    assert found.best.rms_m < 0.02
    assert len(found.best.residuals) == len(control.points)


def test_latitude_first_is_read(cases: Path, fountain: Structure) -> None:
    control, note = settled_axes(fountain, read_control(cases / "gcp" / "f_swapped.txt"))
    assert "exchanged" in note
    assert control.crs == "EPSG:32632"
    assert control_georeference(fountain, control).accepted


def test_names_and_heads_of_control_files(cases: Path) -> None:
    for name in ("tab_space_name", "space_name", "quoted_name"):
        (point,) = read_control(cases / "gcp" / f"{name}.txt").points
        assert (point.name, point.seen[0][0]) == ("g1", "IMG 0001.jpg")
    for name in ("epsg_space", "epsg_comment"):
        assert read_control(cases / "gcp" / f"{name}.txt").crs == "EPSG:32632"


def test_outlines_with_the_old_form_of_a_crs(cases: Path) -> None:
    for crs in (None, "EPSG:2154"):
        options = ModelOptions(crs=crs)
        model = read_city_model(cases / "geojson_crs_epsg_code.json", options)
        assert model.crs == "EPSG:2154"
        assert len(model.buildings) == 3


@dataclass(frozen=True)
class Street:
    """The street of `itowns`, as the verb has it before it is laid into the world."""

    structure: Structure
    walls: tuple[Wall, ...]
    up_sd_rad: float
    photos: tuple[PhotoRecord, ...]
    model: CityModel
    true_m: dict[str, tuple[float, float]]


@pytest.fixture(scope="module")
def street(cases: Path, tmp_path_factory: pytest.TempPathFactory) -> Street:
    """Its photos are turned upright; positions are told by hand, as `make.py` does by EXIF."""
    folder = tmp_path_factory.mktemp("itowns")
    known = {one["id"]: one for one in json.loads(_text(cases, "panoramicsMetaData.json"))}
    to_world = Transformer.from_crs(2154, 4326, always_xy=True)
    positions, true = {}, {}
    for path in sorted((cases / "itowns" / "images").iterdir()):
        station, camera = int(path.stem[-7:]), path.stem.split("-")[2]
        name = f"st{station}_c{camera}.jpg"
        with Image.open(path) as image:
            image.rotate(180).save(folder / name, quality=90)
        place = known[station]
        longitude, latitude = to_world.transform(place["easting"], place["northing"])
        positions[name] = Position(latitude, longitude, place["altitude"])
        true[name] = (place["easting"], place["northing"])
    call = plan_call(folder, Given(from_colmap=cases / "itowns" / "sparse0"))
    photos = read_photos(call.sources).photos
    component: Component = given_model(call.models, photos).components[0]
    by_id = {photo.image_id: read_image(photo.path).pixels for photo in photos}
    edges = segments_by_photo(by_id.__getitem__)
    plain = replace(component, structure=without_parallel(component.structure))
    upright = set_upright(plain, edges)
    outlines = json.loads(_text(cases, "buildingFootprint.json"))
    outlines.pop("crs")
    (folder / "model.geojson").write_text(json.dumps(outlines))
    model = read_city_model(folder / "model.geojson", ModelOptions(crs="EPSG:2154"))
    assert upright.upright is not None
    found = find_walls(upright.structure, WallOptions(), 0)
    return Street(
        upright.structure,
        turned_to_edges(found, upright.structure, edges(upright.structure)),
        upright.upright.whole_sd_rad,
        tuple(_at(photo, positions[photo.name]) for photo in photos),
        model,
        true,
    )


def _text(cases: Path, name: str) -> str:
    return (cases / "itowns" / name).read_text()


def _at(photo: PhotoRecord, position: Position | None) -> PhotoRecord:
    values = {**vars(photo), "position": position}
    return PhotoRecord(**values)


def _laid(street: Street, photos: tuple[PhotoRecord, ...]) -> Georeference:
    references = References(street.model, None)
    found = georeference(
        street.structure, street.walls, photos, references, "model", 0, street.up_sd_rad
    )
    return found.tried[0]


def test_parts_of_facades_are_laid_into_the_model_with_gps(street: Street) -> None:
    found = _laid(street, street.photos)
    assert found.accepted, found.why
    assert found.best is not None
    world = found.best.world_from_model
    places = world.moved(street.structure.centres())[:, :2] + found.origin_m[:2]
    true = np.array([street.true_m[name] for name in street.structure.names])
    assert 0.02 < float(np.linalg.norm(places - true, axis=1).mean()) < 0.25
    # The four walls that lie on facades of the model, by the outlines themselves.
    off = {one.name.split(" at ")[0]: one.distance_m for one in found.best.residuals}
    assert sum(distance < 0.25 for distance in off.values()) >= 4


def test_parts_of_facades_are_refused_without_gps(street: Street) -> None:
    without = tuple(_at(photo, None) for photo in street.photos)
    assert not _laid(street, without).accepted


def _mapped(cases: Path, which: str, first: int) -> Structure:
    """A component of `itowns` as it was mapped, its photos numbered from `first` on."""
    model = pycolmap.Reconstruction(str(cases / "itowns" / which))
    names = {image: model.images[image].name for image in model.images}
    found = structure_of(model, names)
    ids = tuple(range(first, first + len(found.image_ids)))
    camera_of = {
        new: first + found.camera_of[old] for new, old in zip(ids, found.image_ids, strict=True)
    }
    cameras = {first + number: camera for number, camera in found.cameras.items()}
    return replace(found, image_ids=ids, camera_of=camera_of, cameras=cameras)


def test_components_of_a_shared_camera_have_one_focal_length(cases: Path) -> None:
    """Component B had 5,353 px where A has 561 of true 565 to 575, and counted as calibrated."""
    two = [_mapped(cases, "sparse0", 1), _mapped(cases, "sparse1", 101)]
    photos = []
    for structure in two:
        for row, image in enumerate(structure.image_ids):
            camera = structure.camera(row)
            name, size = structure.names[row], (camera.width, camera.height)
            photos.append(
                PhotoRecord(image, name, Path(name), "", *size, None, None, None, None, 1, ())
            )
    camera = CameraOptions(lens="radial", cameras="shared", principal_point="middle")
    components, left = finish_components(two, photos, PhotosOptions(camera=camera))
    focals = [
        float(one.structure.camera(row).mean_focal_length())
        for one in components
        for row in range(len(one.structure.names))
    ]
    assert max(focals) == pytest.approx(min(focals), rel=1e-9)
    assert 540.0 < focals[0] < 600.0
    counted = sum(len(one.structure.names) for one in components)
    assert counted + len(left) == sum(len(structure.names) for structure in two)
