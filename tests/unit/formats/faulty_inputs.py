"""Sound files of each kind that comes from outside, their readers, and faults to put into them."""

from __future__ import annotations

import json
import os
import re
import shutil
from collections.abc import Callable
from pathlib import Path

import numpy as np
from faulty_documents import DOCUMENTS
from faulty_records import RECORDS
from PIL import Image
from place_sample import ball, open_door, posts, sample_place
from sample_document import sample_document
from sample_plan import sample_plan, sample_storey

import veduta
from veduta.cameras.files import read_mat
from veduta.drive.read.las import read_las
from veduta.drive.read.pcd import read_pcd
from veduta.drive.read.surface_model import read_surface_model
from veduta.facade.document import FacadeDocument, Split
from veduta.facade.load import load_document as load_facade
from veduta.fauna.path.ground import ground_of
from veduta.fauna.read.midlines import read_midlines
from veduta.formats.dae_read import read_dae_mesh
from veduta.formats.glb_mesh import read_glb_mesh
from veduta.formats.gltf import glb_bytes
from veduta.formats.mesh_glb import mesh_glb_bytes
from veduta.formats.ply import read_points, write_points
from veduta.grammar.lots import read_lots
from veduta.grammar.terrain import read_terrain
from veduta.imaging.read import read_image
from veduta.plan.load import load_document as load_plan
from veduta.plan.vector.open_dxf import open_dxf

NUMBERS = (b"-1", b"0", b"1e309", b"NaN", b"99999999999999999999", b"1e-320", b"null", b"\xff")
CROSSINGS = (b"{", b"[", b"\x00", b"'", b'"', b"\n", b"<", b"..", b"\xf0\x9f\x8f\x9b")


def mutated(content: bytes, number: int) -> bytes:
    """One to four faults: bytes turned, parts cut out or said twice, numbers that are none."""
    random = np.random.default_rng(number)
    found = bytearray(content)
    for _ in range(int(random.integers(1, 5))):
        if not found:
            break
        at, length = (int(value) for value in random.integers(0, [len(found), 40]))
        kind = int(random.integers(0, 7))
        if kind == 0:
            found[at] ^= 1 << int(random.integers(0, 8))
        elif kind == 1:
            del found[at:]
        elif kind == 2:
            del found[at : at + length]
        elif kind == 3:
            found[at:at] = found[at : at + length] * int(random.integers(1, 4))
        elif kind == 4:
            found[at : at + length] = random.bytes(length)
        elif kind == 5:
            found[at:at] = CROSSINGS[int(random.integers(0, len(CROSSINGS)))] * length
        else:
            numbers = list(re.finditer(rb"-?\d+(\.\d+)?", bytes(found)))
            if numbers:
                one = numbers[int(random.integers(0, len(numbers)))]
                found[one.start() : one.end()] = NUMBERS[int(random.integers(0, len(NUMBERS)))]
    return bytes(found)


def _place_file(suffix: str) -> Callable[[Path], Path]:
    def write(folder: Path) -> Path:
        path = folder / f"place{suffix}"
        sample_place().write(path)
        return path

    return write


def _text(name: str, content: Callable[[], str]) -> Callable[[Path], Path]:
    def write(folder: Path) -> Path:
        (folder / name).write_text(content(), "utf-8")
        return folder / name

    return write


def _geojson() -> str:
    ring = [[0, 0], [12, 0], [12, 9], [0, 9], [0, 0]]
    lot = {"type": "Polygon", "coordinates": [ring]}
    rows = [
        {"type": "Feature", "properties": {"height": 9, "id": n}, "geometry": lot} for n in (1, 2)
    ]
    return json.dumps({"type": "FeatureCollection", "features": rows})


def _facade() -> FacadeDocument:
    """The sample with the rules that a file has to have."""
    document = sample_document()
    floors = [Split(symbols=["Wall"], sizes_m=[document.facade.width_m])] * document.storeys
    rules = document.rules.model_copy(update={"floors": floors})
    return document.model_copy(update={"rules": rules})


def _midlines() -> str:
    rows = [f"{t},{n},{t * 0.02},{n * 3.0},{t * 0.5}" for t in range(8) for n in range(6)]
    return "\n".join(["frame,point,t,x,y", *rows])


def _dxf(folder: Path) -> Path:
    import ezdxf

    drawing = ezdxf.new()
    drawing.modelspace().add_lwpolyline([(0, 0), (5000, 0), (5000, 4000), (0, 4000)], close=True)
    drawing.modelspace().add_text("Kitchen 20 m2").set_placement((900, 900))
    drawing.saveas(folder / "plan.dxf")
    return folder / "plan.dxf"


def _picture(suffix: str) -> Callable[[Path], Path]:
    def write(folder: Path) -> Path:
        pixels = np.random.default_rng(5).integers(0, 255, (24, 32, 3), dtype=np.uint8)
        Image.fromarray(pixels).save(folder / f"photo{suffix}")
        return folder / f"photo{suffix}"

    return write


def _heic(folder: Path) -> Path:
    """One of the photos of telephones in `$VEDUTA_DATA`: nothing here writes HEIC."""
    given = os.environ.get("VEDUTA_DATA")
    data = Path(given) if given else Path(__file__).parents[4] / "shared" / "data"
    photos = sorted((data / "cases/photos/heic_mixed").glob("*.HEIC"))
    if not photos:
        raise FileNotFoundError(f"no cases/photos/heic_mixed in {data}: set VEDUTA_DATA")
    shutil.copyfile(photos[0], folder / "photo.heic")
    return folder / "photo.heic"


def _model(content: Callable[[], bytes]) -> Callable[[Path], Path]:
    def write(folder: Path) -> Path:
        (folder / "model.glb").write_bytes(content())
        return folder / "model.glb"

    return write


def _cloud(folder: Path) -> Path:
    points = np.random.default_rng(7).normal(size=(40, 3))
    write_points(points, np.full((40, 3), 90, dtype=np.uint8), folder / "cloud.ply")
    return folder / "cloud.ply"


def _pcd(folder: Path) -> Path:
    rows = np.random.default_rng(8).normal(size=(20, 3)).astype("<f4")
    head = "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 20\nHEIGHT 1\n"
    text = head + "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 20\nDATA binary\n"
    (folder / "scan.pcd").write_bytes(text.encode() + rows.tobytes())
    return folder / "scan.pcd"


def _manifest(folder: Path) -> Path:
    sample_place().save(folder)
    return folder / "place.json"


def _las(suffix: str) -> Callable[[Path], Path]:
    def write(folder: Path) -> Path:
        import laspy

        cloud = laspy.create(point_format=0, file_version="1.2")
        cloud.header.scales = np.full(3, 0.01)
        cloud.x, cloud.y, cloud.z = np.random.default_rng(9).uniform(0.0, 40.0, (3, 60))
        cloud.write(folder / f"scan{suffix}")
        return folder / f"scan{suffix}"

    return write


def _grid(folder: Path) -> Path:
    import rasterio

    heights = np.random.default_rng(10).uniform(5.0, 9.0, (12, 16)).astype(np.float32)
    place = rasterio.transform.from_origin(500_000.0, 5_000_000.0, 1.0, 1.0)
    with rasterio.open(
        folder / "ground.tif", "w", driver="GTiff", width=16, height=12, count=1,
        dtype="float32", crs="EPSG:25832", transform=place,
    ) as file:  # fmt: skip
        file.write(heights, 1)
    return folder / "ground.tif"


def _mat(folder: Path) -> Path:
    from scipy.io import savemat

    cells = np.empty(3, dtype=object)
    for number in range(3):
        cells[number] = np.arange(12.0).reshape(3, 4) + number
    named = {"P": cells, "K": np.eye(3), "of": {"name": "dino", "count": 3}}
    savemat(folder / "cameras.mat", named, do_compression=True)
    return folder / "cameras.mat"


CLASSES: dict[str, tuple[Callable[[Path], Path], Callable[[Path], object]]] = {
    "glTF": (_place_file(".glb"), veduta.load),
    "GLB with instances": (_model(lambda: glb_bytes(posts())), veduta.load),
    "GLB with a mover": (_model(lambda: glb_bytes(open_door())), veduta.load),
    "GLB of a mesh": (_model(lambda: mesh_glb_bytes(ball())), veduta.load),
    "OBJ": (_place_file(".obj"), veduta.load),
    "STL": (_place_file(".stl"), veduta.load),
    "COLLADA": (_place_file(".dae"), read_dae_mesh),
    "PLY mesh": (_place_file(".ply"), veduta.load),
    "CityGML": (_place_file(".gml"), veduta.load),
    "CityGML 3": (_place_file(".3.gml"), veduta.load),
    "CityJSON": (_place_file(".city.json"), veduta.load),
    "place.json": (_manifest, lambda path: veduta.load(path.parent)),
    "PLY cloud": (_cloud, read_points),
    "PCD": (_pcd, read_pcd),
    "facade.json": (
        _text("facade.json", lambda: _facade().model_dump_json(by_alias=True)),
        load_facade,
    ),
    "plan.json": (
        _text("plan.json", lambda: sample_plan(sample_storey()).model_dump_json(by_alias=True)),
        load_plan,
    ),
    "GeoJSON lots": (_text("lots.geojson", _geojson), read_lots),
    "midlines": (_text("midlines.csv", _midlines), read_midlines),
    "DXF": (_dxf, open_dxf),
    "PNG": (_picture(".png"), read_image),
    "JPEG": (_picture(".jpg"), read_image),
    "TIFF": (_picture(".tif"), read_image),
    "WebP": (_picture(".webp"), read_image),
    "HEIC": (_heic, read_image),
    "GLB of others": (_place_file(".glb"), read_glb_mesh),
    "LAS": (_las(".las"), read_las),
    "LAZ": (_las(".laz"), read_las),
    "GeoTIFF terrain": (_grid, lambda path: read_terrain(path, "EPSG:25832")),
    "GeoTIFF surface": (_grid, lambda path: read_surface_model(path, 2.0)),
    "GeoTIFF ground": (_grid, lambda path: ground_of(path, 1.0)),
    "MATLAB": (_mat, read_mat),
    **RECORDS,
    **DOCUMENTS,
}
