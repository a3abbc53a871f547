"""Sound records of each kind (films, bags, cameras, tables of land), for `faulty_inputs`."""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from pathlib import Path

import cv2
import numpy as np
import pypdfium2
import sets_of_cameras as sets
from known_structure import known_structure

from veduta.cameras import read_cameras
from veduta.cameras.readers.kitti import read_calibration
from veduta.cameras.rigs import find_calibration
from veduta.drive.document.log import Bag
from veduta.drive.read.bag import unpack_in_limits
from veduta.drive.read.own import read_toml
from veduta.formats.colmap_folder import models_in, read_model
from veduta.grammar.lots import read_lots
from veduta.photos.intake.video import look_through, video_of
from veduta.photos.structure import model_of
from veduta.plan.pages import find_drawings, read_drawing

Kind = tuple[Callable[[Path], Path], Callable[[Path], object]]
_DRIVE = """name = "street"
origin = [500000.0, 5000000.0, 80.0]

[vertical]
table = "vertical.parquet"
vehicle_from_scanner = [0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 2.1]
first_beam_rad = -1.5
beam_step_rad = 0.01
farthest_m = 40.0

[path]
table = "path.parquet"
"""
_WALK = "focal_px = 420.5\ncentre_px = [320.0, 240.0]\nbaseline_m = 0.12\n"
_BAG = Bag(file="drive.bag", topics={"path.parquet": "/odom"})


def _pdf(folder: Path) -> Path:
    document = pypdfium2.PdfDocument.new()
    document.new_page(60.0, 40.0)
    document.save(folder / "plan.pdf")
    return folder / "plan.pdf"


def _film(folder: Path) -> Path:
    path = folder / "walk.avi"
    film = cv2.VideoWriter(str(path), cv2.VideoWriter_fourcc(*"MJPG"), 12.0, (64, 48))
    for frame in np.random.default_rng(4).integers(0, 255, (4, 48, 64, 3), dtype=np.uint8):
        film.write(frame)
    film.release()
    return path


def _poses(store: object) -> list[object]:
    types = store.types  # type: ignore[attr-defined]
    found = []
    for second in range(6):
        time = types["builtin_interfaces/msg/Time"](sec=second, nanosec=0)
        header = types["std_msgs/msg/Header"]
        more = {"seq": 0} if "seq" in header.__dataclass_fields__ else {}
        pose = types["geometry_msgs/msg/Pose"](
            position=types["geometry_msgs/msg/Point"](x=1.0 * second, y=0.0, z=0.0),
            orientation=types["geometry_msgs/msg/Quaternion"](x=0.0, y=0.0, z=0.0, w=1.0),
        )
        kind = types["geometry_msgs/msg/PoseStamped"]
        found.append(kind(header=header(stamp=time, frame_id="base", **more), pose=pose))
    return found


def _ros1(folder: Path) -> Path:
    from rosbags.rosbag1 import Writer
    from rosbags.typesys import Stores, get_typestore

    store, kind = get_typestore(Stores.ROS1_NOETIC), "geometry_msgs/msg/PoseStamped"
    packed = Writer(folder / "drive.bag")
    packed.set_compression(Writer.CompressionFormat.BZ2)
    with packed as writer:
        topic = writer.add_connection("/odom", kind, typestore=store)
        for number, message in enumerate(_poses(store)):
            writer.write(topic, number * 10**9, store.serialize_ros1(message, kind))
    return folder / "drive.bag"


def _mcap(folder: Path) -> Path:
    from rosbags.rosbag2 import StoragePlugin, Writer
    from rosbags.typesys import Stores, get_typestore

    store, kind = get_typestore(Stores.ROS2_HUMBLE), "geometry_msgs/msg/PoseStamped"
    with Writer(folder / "bag", version=9, storage_plugin=StoragePlugin.MCAP) as writer:
        topic = writer.add_connection("/odom", kind, typestore=store)
        for number, message in enumerate(_poses(store)):
            writer.write(topic, number * 10**9, store.serialize_cdr(message, kind))
    return next((folder / "bag").glob("*.mcap")).rename(folder / "drive.mcap")


def _read_bag(path: Path) -> object:
    toml = path.with_name("drive.toml")
    toml.write_text(_DRIVE, "utf-8")
    bag = _BAG.model_copy(update={"file": path.name})
    with tempfile.TemporaryDirectory() as scratch:
        return unpack_in_limits(path.parent, read_toml(toml), bag, Path(scratch))


def lots_file(suffix: str, driver: str) -> Callable[[Path], Path]:
    """Three lots with heights in a file of this kind."""

    def write(folder: Path) -> Path:
        import pyogrio
        import shapely

        squares = [shapely.box(20.0 * n, 0.0, 20.0 * n + 12.0, 9.0) for n in range(3)]
        pyogrio.raw.write(
            folder / f"lots{suffix}",
            np.asarray(shapely.to_wkb(squares), dtype=object),
            [np.array([6.0, 9.0, 12.0])],
            ["height"],
            crs="EPSG:25832",
            geometry_type="Polygon",
            driver=driver,
        )
        return folder / f"lots{suffix}"

    return write


def _colmap(name: str) -> Callable[[Path], Path]:
    def write(folder: Path) -> Path:
        params = (1400.0, 1390.0, 801.0, 600.5, -0.05, 0.01, 0.001, -0.002)
        model = model_of(known_structure("OPENCV", params, points=20, photos=3))
        (model.write_binary if name.endswith(".bin") else model.write_text)(folder)
        return folder / name

    return write


def cameras_file(
    name: str, write: Callable[[Path, list[sets.Camera]], None]
) -> Callable[[Path], Path]:
    """A ring of cameras with their pictures; name: of the file that faults are put into."""

    def written(folder: Path) -> Path:
        sets.write_pictures(folder)
        write(folder, sets.ring())
        return folder / name

    return written


def _kitti(folder: Path) -> Path:
    sets.write_kitti(folder / "00", sets.ring(), ("image_2", "image_3"), keys=True)
    return folder / "00" / "calib.txt"


def text_file(name: str, content: str) -> Callable[[Path], Path]:
    """A file of this text."""

    def write(folder: Path) -> Path:
        (folder / name).write_text(content, "utf-8")
        return folder / name

    return write


def _read_colmap(path: Path) -> object:
    return read_model(models_in(path.parent)[0])


def _read_rig(path: Path) -> object:
    return find_calibration(path.parent, path, "image_2")


_OPENCV = cameras_file("calibration.yml", lambda at, of: sets.write_opencv(at, of, [0.0] * 5))
RECORDS: dict[str, Kind] = {
    "PDF": (_pdf, lambda path: [read_drawing(one) for one in find_drawings([path])]),
    "film": (_film, lambda path: look_through(video_of(path))),
    "ROS 1 bag": (_ros1, _read_bag),
    "MCAP": (_mcap, _read_bag),
    "GeoPackage lots": (lots_file(".gpkg", "GPKG"), read_lots),
    "Shapefile lots": (lots_file(".shp", "ESRI Shapefile"), read_lots),
    "COLMAP text": (_colmap("images.txt"), _read_colmap),
    "COLMAP binary": (_colmap("images.bin"), _read_colmap),
    "COLMAP points": (_colmap("points3D.bin"), _read_colmap),
    "OpenCV cameras": (_OPENCV, read_cameras),
    "OpenMVG": (cameras_file("sfm_data.json", sets.write_openmvg), read_cameras),
    "OpenSfM": (cameras_file("reconstruction.json", sets.write_opensfm), read_cameras),
    "KITTI calib": (_kitti, read_calibration),
    "KITTI sequence": (_kitti, lambda path: read_cameras(path.parent)),
    "KITTI rig": (_kitti, _read_rig),
    "drive.toml": (text_file("drive.toml", _DRIVE), read_toml),
    "walk.toml": (text_file("walk.toml", _WALK), _read_rig),
}
