"""Messages of a bag as rows of tables, by their kinds."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from veduta.drive.document.log import Bag, DriveLog, Scanner
from veduta.drive.read.bag_transforms import Transforms
from veduta.run.errors import InputError

_ANGLE_RAD = 2e-3
"""How far the beams of messages may be from those of drive.toml."""
_FLOATS = {7: "f4", 8: "f8"}
"""PointField's FLOAT32 and FLOAT64."""
_MOST_POINTS = 50_000_000
STATIC = "/tf_static"
Row = dict[str, Any]


class BagRows:
    """What makes rows of messages. scratch: where images and full scans are written."""

    def __init__(self, log: DriveLog, bag: Bag, path: Path, scratch: Path) -> None:
        self._scanners = {
            one.table: one for one in (log.vertical, log.horizontal) if one is not None
        }
        self._full = None if log.full is None else log.full.table
        self._bag, self._path, self._scratch = bag, path, scratch
        self._written: set[Path] = set()
        frames = None if log.path is None else log.path.tf
        self._transforms = None if frames is None else Transforms(*frames)

    def row(self, table: str, kind: str, message: Any, stamp_s: float) -> Row | None:
        """None of a transform that tells nothing of the vehicle. InputError of another kind.

        A bag holds the description of its own messages, where fields may have other names.
        """
        try:
            return self._row(table, kind, message, stamp_s)
        except AttributeError as error:
            fault = f"has {kind} in {self._bag.topics[table]} without {error.name}"
            raise InputError(self._path, fault, "Record it again, or convert it.") from error

    def _row(self, table: str, kind: str, message: Any, stamp_s: float) -> Row | None:
        name = kind.rsplit("/", 1)[-1]
        if name in ("TFMessage", "tfMessage"):
            return self._moved(message, table, stamp_s)
        time_s = _time(message, stamp_s)
        if name == "LaserScan" and table in self._scanners:
            return {
                "time_s": time_s,
                "ranges_m": _ranges(message, self._scanners[table], self._path),
            }
        if name == "PointCloud2" and table == self._full:
            return {"time_s": time_s, "file": self._cloud(message, table, time_s)}
        if name == "Odometry":
            return {"time_s": time_s, "matrix": _matrix(message.pose.pose)}
        if name == "PoseStamped":
            return {"time_s": time_s, "matrix": _matrix(message.pose)}
        if name == "NavSatFix":
            return {
                "time_s": time_s, "longitude_deg": float(message.longitude),
                "latitude_deg": float(message.latitude),
            }  # fmt: skip
        if name == "CompressedImage":
            return {"time_s": time_s, "file": self._image(message, table, time_s)}
        fault = f"has {kind} in {self._bag.topics[table]}, which cannot become {table}"
        raise InputError(self._path, fault, "LaserScan, PointCloud2, Odometry, PoseStamped, tf,"
                         " NavSatFix and CompressedImage are read.")  # fmt: skip

    def empty(self, table: str) -> InputError:
        """Why a table has no row."""
        topic = self._bag.topics[table]
        if self._transforms is not None and self._transforms.frames:
            fault = f"has no transforms in {topic} from {self._transforms.told}"
            there = ", ".join(sorted(self._transforms.frames)[:20])
            return InputError(self._path, fault, f"Its frames are: {there}. Name two in path.tf.")
        fault = f"has no message in {topic} that can be read"
        return InputError(self._path, fault, f"Record it again, or take {table} out of drive.toml.")

    def _moved(self, message: Any, table: str, stamp_s: float) -> Row | None:
        if self._transforms is None:
            fault = f"has transforms in {self._bag.topics[table]}, and drive.toml names no frames"
            raise InputError(self._path, fault, 'Write [path] tf = ["map", "base_link"].')
        moved_s = None
        for one in message.transforms:
            pose = np.vstack([np.reshape(_pose(one.transform.translation, one.transform.rotation),
                                         (3, 4)), [0.0, 0.0, 0.0, 1.0]])  # fmt: skip
            if self._transforms.hear(one.header.frame_id, one.child_frame_id, pose):
                moved_s = _time(one, stamp_s)
        place = self._transforms.place()
        if moved_s is None or place is None:
            return None
        return {"time_s": moved_s, "matrix": place[:3].ravel().tolist()}

    def _cloud(self, message: Any, table: str, time_s: float) -> str:
        points = points_of(message, self._path)
        file = self._file(table, time_s, "npy")
        np.save(file, points, allow_pickle=False)
        return f"{file.parent.name}/{file.name}"

    def _image(self, message: Any, table: str, time_s: float) -> str:
        data = bytes(message.data)
        file = self._file(table, time_s, "png" if data.startswith(b"\x89PNG") else "jpg")
        file.write_bytes(data)
        return f"{file.parent.name}/{file.name}"

    def _file(self, table: str, time_s: float, suffix: str) -> Path:
        """Called by the microsecond, and by a number where that one has several of a table."""
        folder = self._scratch / f"{Path(table).stem}-files"
        folder.mkdir(exist_ok=True)
        stem = f"{round(time_s * 1e6)}"
        file, count = folder / f"{stem}.{suffix}", 1
        while file in self._written:
            count += 1
            file = folder / f"{stem}-{count}.{suffix}"
        self._written.add(file)
        return file


def points_of(message: Any, path: Path) -> NDArray[np.float32]:
    """(n, 3) x, y, z of a PointCloud2, those that are numbers. InputError says what is wrong."""
    order = ">" if message.is_bigendian else "<"
    count, step = int(message.width) * int(message.height), int(message.point_step)
    fields = {one.name: one for one in message.fields}
    if any(name not in fields or fields[name].datatype not in _FLOATS for name in "xyz"):
        fault = f"has points with {', '.join(fields) or 'nothing'}, not x, y and z as floats"
        raise InputError(path, fault, "Record the points of the scanner's driver.")
    widest = max(int(fields[n].offset) + int(_FLOATS[fields[n].datatype][1]) for n in "xyz")
    if count > _MOST_POINTS or widest > step or count * step > len(message.data):
        fault = f"has a scan of {count} points in {len(message.data)} bytes"
        raise InputError(path, fault, "Record it again.")
    kind = np.dtype({
        "names": list("xyz"), "itemsize": step,
        "formats": [order + _FLOATS[fields[name].datatype] for name in "xyz"],
        "offsets": [int(fields[name].offset) for name in "xyz"],
    })  # fmt: skip
    rows = np.frombuffer(bytes(message.data), dtype=kind, count=count)
    points = np.stack([rows[name].astype(np.float32) for name in "xyz"], axis=1)
    return np.asarray(points[np.isfinite(points).all(axis=1)], dtype=np.float32)


def _time(message: Any, stamp_s: float) -> float:
    stamp = message.header.stamp
    own = float(stamp.sec) + 1e-9 * float(stamp.nanosec)
    return own if own > 0.0 else stamp_s


def _ranges(message: Any, scanner: Scanner, path: Path) -> NDArray[np.float32]:
    ranges = np.array(message.ranges, dtype=np.float32)
    first, step = float(message.angle_min), float(message.angle_increment)
    last = abs(
        first + step * len(ranges) - scanner.first_beam_rad - scanner.beam_step_rad * len(ranges)
    )
    if abs(first - scanner.first_beam_rad) > _ANGLE_RAD or last > 10 * _ANGLE_RAD:
        fault = f"has beams from {first:.4f} rad, {step:.5f} rad apart, and drive.toml others"
        remedy = f"Write first_beam_rad = {first:.6f}, beam_step_rad = {step:.8f}."
        raise InputError(path, fault, remedy)
    with np.errstate(invalid="ignore"):
        ranges[~((ranges >= message.range_min) & (ranges <= message.range_max))] = 0.0
    return ranges


def _matrix(pose: Any) -> list[float]:
    """3x4 by rows of a pose with a quaternion."""
    return _pose(pose.position, pose.orientation)


def _pose(place: Any, turn: Any) -> list[float]:
    x, y, z, w = np.array([turn.x, turn.y, turn.z, turn.w]) / max(
        float(np.linalg.norm([turn.x, turn.y, turn.z, turn.w])), 1e-12
    )
    return [
        1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w), float(place.x),
        2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w), float(place.y),
        2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y), float(place.z),
    ]  # fmt: skip
