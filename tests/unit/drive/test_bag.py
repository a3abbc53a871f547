"""Bags of both kinds become the tables that were recorded into them, also where they were cut
off.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from rosbags.highlevel import AnyReader
from rosbags.rosbag1 import Writer as Writer1
from rosbags.rosbag2 import StoragePlugin
from rosbags.rosbag2 import Writer as Writer2
from rosbags.typesys import Stores, get_typestore

from veduta.drive.read import own
from veduta.drive.read.bag import unpack_bag
from veduta.drive.read.bag_mend import mend_bag
from veduta.drive.read.own import read_own, read_toml
from veduta.run.errors import InputError
from veduta.synthetic.drives import (
    DriveScans,
    StreetOptions,
    TruckOptions,
    build_street,
    scan_street,
    write_drive,
)

_BAG = '\n[bag]\nfile = "{}"\n[bag.topics]\n"vertical.parquet" = "/up"\n"path.parquet" = "/odom"\n'


@pytest.fixture(scope="module")
def scans() -> DriveScans:
    return scan_street(build_street(StreetOptions(length_m=20.0), 3), TruckOptions(), 3)


def _messages(store: object, scans: DriveScans) -> list[tuple[str, str, int, object]]:
    """Topic, kind, nanoseconds and message, in the order of time."""
    types = store.types  # type: ignore[attr-defined]

    def stamp(time_s: float) -> object:
        sec, part = divmod(round(time_s * 1e9), 10**9)
        header = types["std_msgs/msg/Header"]
        names = header.__dataclass_fields__
        time = types["builtin_interfaces/msg/Time"](sec=sec, nanosec=part)
        more = {"seq": 0} if "seq" in names else {}
        return header(stamp=time, frame_id="base", **more)

    found = []
    step = float(scans.angles_rad[1] - scans.angles_rad[0])
    for row, time_s in enumerate((scans.times_s + 5.0).tolist()):
        scan = types["sensor_msgs/msg/LaserScan"](
            header=stamp(time_s), angle_min=float(scans.angles_rad[0]),
            angle_max=float(scans.angles_rad[-1]), angle_increment=step, time_increment=0.0,
            scan_time=0.0, range_min=0.4, range_max=80.0, ranges=scans.ranges[row],
            intensities=np.zeros(0, np.float32),
        )  # fmt: skip
        x, y, z = scans.world_from_vehicle[row, :, 3].tolist()
        yaw = float(
            np.arctan2(scans.world_from_vehicle[row, 1, 0], scans.world_from_vehicle[row, 0, 0])
        )
        pose = types["geometry_msgs/msg/PoseStamped"](
            header=stamp(time_s),
            pose=types["geometry_msgs/msg/Pose"](
                position=types["geometry_msgs/msg/Point"](x=x, y=y, z=z),
                orientation=types["geometry_msgs/msg/Quaternion"](
                    x=0.0, y=0.0, z=float(np.sin(yaw / 2)), w=float(np.cos(yaw / 2))
                ),
            ),
        )  # fmt: skip
        stamp_ns = round(time_s * 1e9)
        found.append(("/up", "sensor_msgs/msg/LaserScan", stamp_ns, scan))
        found.append(("/odom", "geometry_msgs/msg/PoseStamped", stamp_ns, pose))
    return found


@pytest.fixture(params=["drive.bag", "drive.mcap"])
def folder(request: pytest.FixtureRequest, scans: DriveScans, tmp_path: Path) -> tuple[Path, Path]:
    """A log's folder and the bag in it."""
    log = tmp_path / "log"
    write_drive(scans, log)
    (log / "vertical.parquet").unlink()
    (log / "path.parquet").unlink()
    toml = log / "drive.toml"
    toml.write_text(toml.read_text() + _BAG.format(request.param))
    bag = log / str(request.param)
    if bag.suffix == ".bag":
        store = get_typestore(Stores.ROS1_NOETIC)
        packed = Writer1(bag)
        packed.set_compression(Writer1.CompressionFormat.BZ2)
        with packed as writer:
            writer.chunk_threshold = 20_000
            known = {}
            for topic, kind, time_ns, message in _messages(store, scans):
                if topic not in known:
                    known[topic] = writer.add_connection(topic, kind, typestore=store)
                writer.write(known[topic], time_ns, store.serialize_ros1(message, kind))
    else:
        store = get_typestore(Stores.ROS2_HUMBLE)
        whole = tmp_path / "whole"
        with Writer2(whole, version=9, storage_plugin=StoragePlugin.MCAP) as writer2:
            known = {}
            for topic, kind, time_ns, message in _messages(store, scans):
                if topic not in known:
                    known[topic] = writer2.add_connection(topic, kind, typestore=store)
                writer2.write(known[topic], time_ns, store.serialize_cdr(message, kind))
        next(whole.glob("*.mcap")).rename(bag)
    return log, bag


def _points(record_points: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.round(record_points, 3)


def test_bag_is_what_was_recorded(
    folder: tuple[Path, Path], scans: DriveScans, tmp_path: Path
) -> None:
    log, _ = folder
    write_drive(scans, tmp_path / "plain")
    expected, found = read_own(tmp_path / "plain"), read_own(log, scratch=tmp_path / "scratch")
    assert len(found.sweeps) == len(expected.sweeps)
    for row in (0, 30, 90):
        one, two = expected.sweeps[row].world_points(), found.sweeps[row].world_points()
        np.testing.assert_allclose(one, two, atol=1e-4)
    assert not found.notes


def test_of_a_bag_cut_in_the_middle_the_readable_part_is_used_and_said(
    folder: tuple[Path, Path], scans: DriveScans, tmp_path: Path
) -> None:
    log, bag = folder
    with bag.open("r+b") as file:
        file.truncate(int(bag.stat().st_size * 0.6))
    if bag.suffix == ".mcap":
        # All messages of a short MCAP are in one chunk, which is then not whole.
        with pytest.raises(InputError, match="has no topic"):
            read_own(log, scratch=tmp_path / "scratch")
        return
    record = read_own(log, scratch=tmp_path / "scratch")
    assert 0.3 * len(scans.times_s) < len(record.sweeps) < 0.8 * len(scans.times_s)
    assert any("was cut off" in note for note in record.notes)


def test_topic_that_is_not_there_is_told(folder: tuple[Path, Path], tmp_path: Path) -> None:
    log, _ = folder
    toml = log / "drive.toml"
    toml.write_text(toml.read_text().replace('"/up"', '"/upright"'))
    with pytest.raises(InputError, match=r"no topic /upright.*It has: /odom, /up"):
        read_own(log, scratch=tmp_path / "scratch")


def test_other_beams_than_described_are_refused(folder: tuple[Path, Path], tmp_path: Path) -> None:
    log, _ = folder
    toml = log / "drive.toml"
    text = toml.read_text()
    toml.write_text(text.replace("first_beam_rad = -1.57", "first_beam_rad = -1.27"))
    with pytest.raises(InputError, match=r"has beams from -1.5708.*first_beam_rad = -1.570796"):
        read_own(log, scratch=tmp_path / "scratch")


def test_topics_that_make_no_tables_are_told(folder: tuple[Path, Path], tmp_path: Path) -> None:
    log, _ = folder
    toml = log / "drive.toml"
    text = toml.read_text()
    toml.write_text(text + '"more.parquet" = "/up"\n')
    with pytest.raises(InputError, match=r"one topic to two tables.*Give each"):
        read_own(log, scratch=tmp_path / "scratch")


def test_a_message_that_is_none_of_its_type_is_left_out_and_said(
    folder: tuple[Path, Path], scans: DriveScans, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    log, _ = folder
    whole, count = AnyReader.deserialize, 0

    def broken(self: AnyReader, raw: bytes, kind: str) -> object:
        nonlocal count
        count += 1
        return whole(self, raw[: len(raw) // 2] if count == 9 else raw, kind)

    monkeypatch.setattr(AnyReader, "deserialize", broken)
    monkeypatch.setattr(own, "unpack_in_limits", unpack_bag)  # here, where it is broken
    record = read_own(log, scratch=tmp_path / "scratch")
    assert len(record.sweeps) >= len(scans.times_s) - 1
    assert any(note.startswith("1 messages of drive.") for note in record.notes)
    monkeypatch.setattr(AnyReader, "deserialize", lambda self, raw, kind: whole(self, b"", kind))
    with pytest.raises(InputError, match=r"no message in .* that can be read.*drive.toml"):
        read_own(log, scratch=tmp_path / "again")


def test_messages_whose_fields_have_other_names_are_refused(
    folder: tuple[Path, Path], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    log, _ = folder
    monkeypatch.setattr(AnyReader, "deserialize", lambda self, raw, kind: object())
    monkeypatch.setattr(own, "unpack_in_limits", unpack_bag)  # here, where it is broken
    with pytest.raises(InputError, match=r"has .* in /(up|odom) without header\. Record it again"):
        read_own(log, scratch=tmp_path / "scratch")


def test_mutated_bags_give_tables_or_a_reason(folder: tuple[Path, Path], tmp_path: Path) -> None:
    log, bag = folder
    sound = bag.read_bytes()
    description = read_toml(log / "drive.toml")
    assert description.bag is not None
    random = np.random.default_rng(11)
    told = []
    for number in range(40):
        data = bytearray(sound)
        for at in random.integers(0, len(data), 1 + number % 4).tolist():
            data[at : at + 9] = random.bytes(9)
        bag.write_bytes(bytes(data[: len(data) - number * 37]))
        try:
            unpack_bag(log, description, description.bag, tmp_path / f"{number}", lambda _: None)
        except InputError as error:
            told.append(str(error))
    assert told
    assert [text for text in told if bag.name not in text] == []


def test_chunks_are_unpacked_to_a_bound(
    folder: tuple[Path, Path], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    _, bag = folder
    if bag.suffix == ".mcap":
        pytest.skip("its chunks are copied as they are")
    monkeypatch.setattr("veduta.drive.read.bag_mend._MOST_CHUNK", 1000)
    with pytest.raises(InputError, match="larger than 1,000 bytes"):
        mend_bag(bag, tmp_path)


def test_what_is_no_bag_is_told(folder: tuple[Path, Path], tmp_path: Path) -> None:
    log, bag = folder
    bag.write_bytes(b"no bag at all" * 100)
    with pytest.raises(InputError, match=r"no ROS bag and no MCAP"):
        read_own(log, scratch=tmp_path / "scratch")
    bag.unlink()
    with pytest.raises(InputError, match="no such bag"):
        read_own(log, scratch=tmp_path / "scratch")
