"""Full scans (PointCloud2) and transforms (tf) of bags, and full scans as files."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from drawn_street import street
from numpy.typing import NDArray
from rosbags.rosbag1 import Writer as Writer1
from rosbags.rosbag2 import StoragePlugin
from rosbags.rosbag2 import Writer as Writer2
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from scipy.spatial.transform import Rotation

from veduta.drive.document.log import Bag
from veduta.drive.read.bag_rows import BagRows, points_of
from veduta.drive.read.own import read_own
from veduta.run.errors import InputError

COUNT = 6
TRANSFORMS = "tf2_msgs/msg/TFMessage"
MOUNT = (1.0, 0.0, 0.0, 0.4, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.8)
TOML = """name = "Full"
[full]
table = "full.parquet"
vehicle_from_scanner = [1, 0, 0, 0.4,  0, 1, 0, 0,  0, 0, 1, 1.8]
"""
BAG = """[path]
table = "path.parquet"
tf = ["map", "base_link"]
[bag]
file = "{}"
[bag.topics]
"full.parquet" = "/points"
"path.parquet" = "/tf"
"""


def _scan(row: int) -> NDArray[np.float32]:
    points = np.random.default_rng(row).uniform(-20.0, 20.0, (200, 3)).astype(np.float32)
    points[np.linalg.norm(points, axis=1) < 3.0] += 9.0
    return points


def _links(row: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """(4, 4) map from odom, which is corrected once, and odom from base_link."""
    corrected, driven = np.eye(4), np.eye(4)
    corrected[:3, :3] = Rotation.from_euler("z", 0.3 if row < 3 else 0.32).as_matrix()
    corrected[:3, 3] = (5.0, -2.0, 0.1)
    driven[:3, :3] = Rotation.from_euler("zyx", [0.1 * row, 0.02, 0.01]).as_matrix()
    driven[:3, 3] = (0.8 * row, 0.1 * row, 0.0)
    return corrected, driven


def _messages(types: Any) -> list[tuple[str, str, int, Any]]:
    def header(time_ns: int, frame: str) -> Any:
        kind = types["std_msgs/msg/Header"]
        time = types["builtin_interfaces/msg/Time"](sec=time_ns // 10**9, nanosec=time_ns % 10**9)
        more = {"seq": 0} if "seq" in kind.__dataclass_fields__ else {}
        return kind(stamp=time, frame_id=frame, **more)

    def link(time_ns: int, parent: str, child: str, pose: NDArray[np.float64]) -> Any:
        x, y, z, w = Rotation.from_matrix(pose[:3, :3]).as_quat().tolist()
        turn = types["geometry_msgs/msg/Quaternion"](x=x, y=y, z=z, w=w)
        move = types["geometry_msgs/msg/Vector3"](*pose[:3, 3].tolist())
        return types["geometry_msgs/msg/TransformStamped"](
            header=header(time_ns, parent), child_frame_id=child,
            transform=types["geometry_msgs/msg/Transform"](translation=move, rotation=turn),
        )  # fmt: skip

    def cloud(time_ns: int, points: NDArray[np.float32]) -> Any:
        """x, y, z with four bytes of another kind between them, as drivers send them."""
        rows = np.zeros((len(points), 5), dtype=np.float32)
        rows[:, [0, 1, 3]] = points
        rows[0, 0] = np.nan
        fields = [
            types["sensor_msgs/msg/PointField"](name=name, offset=offset, datatype=7, count=1)
            for name, offset in (("x", 0), ("y", 4), ("intensity", 8), ("z", 12))
        ]
        data = np.frombuffer(rows.tobytes(), dtype=np.uint8)
        return types["sensor_msgs/msg/PointCloud2"](
            header=header(time_ns, "lidar"), height=1, width=len(points), fields=fields,
            is_bigendian=False, point_step=20, row_step=20 * len(points), data=data, is_dense=False,
        )  # fmt: skip

    transforms = TRANSFORMS
    message = types[transforms]
    found: list[tuple[str, str, int, Any]] = []
    # From the base to the scanner: no link between the map and the vehicle.
    static = message(transforms=[link(10**9, "base_link", "lidar", np.eye(4))])
    found.append(("/tf_static", transforms, 10**9, static))
    for row in range(COUNT):
        stamp = 10**9 + (row + 1) * 10**8
        corrected, driven = _links(row)
        both = [link(stamp, "map", "odom", corrected), link(stamp, "/odom", "base_link", driven)]
        found.append(("/tf", transforms, stamp, message(transforms=both)))
        found.append(("/points", "sensor_msgs/msg/PointCloud2", stamp, cloud(stamp, _scan(row))))
    return found


@pytest.fixture(params=["drive.bag", "ros2", "drive.mcap"])
def log(request: pytest.FixtureRequest, tmp_path: Path) -> Path:
    """A folder with a drive.toml and a bag of each kind."""
    folder = tmp_path / "log"
    folder.mkdir()
    name = str(request.param)
    (folder / "drive.toml").write_text(TOML + BAG.format(name))
    if name.endswith(".bag"):
        store = get_typestore(Stores.ROS1_NOETIC)
        told = "geometry_msgs/TransformStamped[] transforms"
        store.register(get_types_from_msg(told, TRANSFORMS))
        with Writer1(folder / name) as writer:
            _write(writer, store, store.serialize_ros1)
        return folder
    store = get_typestore(Stores.ROS2_HUMBLE)
    plugin = StoragePlugin.MCAP if name.endswith(".mcap") else StoragePlugin.SQLITE3
    with Writer2(folder / "ros2", version=9, storage_plugin=plugin) as writer2:
        _write(writer2, store, store.serialize_cdr)
    if name.endswith(".mcap"):
        next((folder / "ros2").glob("*.mcap")).rename(folder / name)
    return folder


def _write(writer: Any, store: Any, packed: Callable[[Any, str], Any]) -> None:
    known: dict[str, Any] = {}
    for topic, kind, time_ns, message in _messages(store.types):
        if topic not in known:
            known[topic] = writer.add_connection(topic, kind, typestore=store)
        writer.write(known[topic], time_ns, packed(message, kind))


def test_scans_stand_where_the_transforms_say(log: Path, tmp_path: Path) -> None:
    record = read_own(log, scratch=tmp_path / "scratch")
    assert record.full
    assert len(record.sweeps) == COUNT
    mount = np.vstack([np.reshape(MOUNT, (3, 4)), [0, 0, 0, 1]])
    for row, sweep in enumerate(record.sweeps):
        corrected, driven = _links(row)
        np.testing.assert_allclose(
            sweep.world_from_sensor, corrected @ driven @ mount, atol=1e-6
        )  # fmt: skip
        np.testing.assert_array_equal(sweep.read(), _scan(row)[1:].astype(np.float64))
    assert not record.notes


def _changed(log: Path, old: str, new: str) -> None:
    toml = log / "drive.toml"
    text = toml.read_text()
    assert old in text
    toml.write_text(text.replace(old, new))


def test_frames_that_are_not_there_are_told(log: Path, tmp_path: Path) -> None:
    _changed(log, '"map", "base_link"', '"map", "car"')
    with pytest.raises(InputError, match=r"no transforms in /tf from map to car.*base_link, lidar"):
        read_own(log, scratch=tmp_path / "scratch")


def test_transforms_without_frames_are_told(log: Path, tmp_path: Path) -> None:
    _changed(log, 'tf = ["map", "base_link"]\n', "")
    with pytest.raises(InputError, match=r"names no frames.*Write \[path\] tf"):
        read_own(log, scratch=tmp_path / "scratch")


def _cloud(names: str, count: int, data: bytes) -> SimpleNamespace:
    fields = [
        SimpleNamespace(name=name, offset=4 * row, datatype=7) for row, name in enumerate(names)
    ]
    return SimpleNamespace(
        is_bigendian=True, width=count, height=1, point_step=12, fields=fields, data=data
    )


def test_scans_that_are_no_points_are_told() -> None:
    path = Path("a.bag")
    rows = np.arange(6, dtype=">f4").tobytes()
    expected = np.arange(6.0).reshape(2, 3)
    np.testing.assert_array_equal(points_of(_cloud("xyz", 2, rows), path), expected)
    with pytest.raises(InputError, match=r"a\.bag.*points with x, y, i, not x, y and z"):
        points_of(_cloud("xyi", 2, rows), path)
    with pytest.raises(InputError, match="3 points in 24 bytes"):
        points_of(_cloud("xyz", 3, rows), path)


def test_two_scans_of_one_microsecond_are_two_files(tmp_path: Path) -> None:
    full: Any = SimpleNamespace(table="full.parquet")
    log: Any = SimpleNamespace(vertical=None, horizontal=None, full=full, path=None)
    rows = BagRows(
        log, Bag(file="a.bag", topics={"full.parquet": "/points"}), tmp_path / "a.bag", tmp_path
    )
    names = []
    for value in (1.0, 2.0):
        points = np.full(3, value, dtype=">f4")
        message = _cloud("xyz", 1, points.tobytes())
        message.header = SimpleNamespace(stamp=SimpleNamespace(sec=7, nanosec=100))
        row = rows.row("full.parquet", "sensor_msgs/msg/PointCloud2", message, 0.0)
        assert row is not None
        names.append(row["file"])
    read = [np.load(tmp_path / name)[0, 0] for name in names]
    assert read == [1.0, 2.0]


def _files(folder: Path, places: NDArray[np.float64]) -> None:
    """Scans of a street with things in it, from places along it: x is along the street."""
    folder.mkdir()
    random = np.random.default_rng(2)
    posts = np.column_stack([random.uniform(-8.5, 6.0, 30), random.uniform(0.0, 20.0, 30)])
    posts = posts[np.abs(posts[:, 0]) > 3.0]
    wide = np.repeat(posts, 400, axis=0) + random.uniform(-0.3, 0.3, (400 * len(posts), 2))
    things = np.column_stack([wide, random.uniform(0.0, 2.5, len(wide))])
    points = np.concatenate([street()[0], things])
    names = []
    for row, place in enumerate(places):
        about = points - place
        seen = np.column_stack([about[:, 1], -about[:, 0], about[:, 2]])
        near = seen[(np.abs(seen[:, 0]) < 12.0) & (np.linalg.norm(seen, axis=1) > 2.3)]
        names.append(f"{row}.npy")
        np.save(folder / names[-1], near)
    table = pa.table({"time_s": np.arange(len(names)) * 0.1, "file": names})
    pq.write_table(table, folder / "full.parquet")
    (folder / "drive.toml").write_text(TOML)


def test_full_scans_without_poses_are_registered(tmp_path: Path) -> None:
    places = np.array([[0.0, 6.0 + 0.5 * row, 1.8] for row in range(4)])
    _files(tmp_path / "log", places)
    record = read_own(tmp_path / "log")
    assert record.path_from == "registration of the scans"
    steps = np.diff(record.path(), axis=0)
    np.testing.assert_allclose(np.linalg.norm(steps, axis=1), 0.5, atol=0.1)
    assert record.height_m == pytest.approx(1.8, abs=0.05)


def test_missing_and_broken_scans_are_told(tmp_path: Path) -> None:
    log = tmp_path / "log"
    _files(log, np.array([[0.0, 6.0 + 0.5 * row, 1.8] for row in range(4)]))
    (log / "3.npy").unlink()
    assert any("1 of 4 scans are missing" in note for note in read_own(log).notes)
    (log / "1.npy").write_bytes(b"no array")
    with pytest.raises(InputError, match=r"1\.npy.*no array"):
        read_own(log)
    np.save(log / "1.npy", np.zeros((3, 4)))
    with pytest.raises(InputError, match=r"\(3, 4\)"):
        read_own(log)
    table = pa.table({"time_s": [0.0, 0.1], "file": ["../0.npy", "1.npy"]})
    pq.write_table(table, log / "full.parquet")
    with pytest.raises(InputError, match="outside of the folder"):
        read_own(log)


def test_a_log_without_a_scanner_is_told(tmp_path: Path) -> None:
    (tmp_path / "drive.toml").write_text('name = "nothing"\n')
    with pytest.raises(InputError, match=r"neither a \[vertical\] scanner nor \[full\]"):
        read_own(tmp_path)
