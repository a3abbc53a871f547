"""A drive as files: `drive.toml` and Parquet tables, as `veduta drive` reads them."""

from __future__ import annotations

from pathlib import Path

import pyarrow
import pyarrow.parquet

from veduta.synthetic.drives.scan import DriveScans

_TOML = """name = "{name}"

[vertical]
table = "vertical.parquet"
# Across the vehicle: x of the scanner to the left, y up, z forward.
vehicle_from_scanner = [0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, {height}]
first_beam_rad = {first}
beam_step_rad = {step}
farthest_m = {farthest}
"""
_LEVEL = """
[horizontal]
table = "horizontal.parquet"
# Level: x of the scanner forward, y to the left.
vehicle_from_scanner = [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, {height}]
first_beam_rad = 0.0
beam_step_rad = {step}
farthest_m = {farthest}
"""
_PATH = """
[path]
table = "path.parquet"
"""


def write_drive(
    scans: DriveScans, folder: Path, name: str = "drive", *, poses: bool = True
) -> None:
    """Write into a folder, which is made. poses: whether the true path goes with it."""
    folder.mkdir(parents=True, exist_ok=True)
    angles = scans.angles_rad
    text = (_TOML + (_LEVEL if scans.level_ranges is not None else "")).format(
        name=name, height=scans.options.height_m, first=float(angles[0]),
        step=float(angles[1] - angles[0]), farthest=scans.options.farthest_m,
    )  # fmt: skip
    text += _PATH if poses else ""
    (folder / "drive.toml").write_text(text, encoding="utf-8")
    rows = {"time_s": scans.times_s, "ranges_m": list(scans.ranges)}
    pyarrow.parquet.write_table(pyarrow.table(rows), folder / "vertical.parquet")
    if scans.level_ranges is not None:
        level = {"time_s": scans.times_s, "ranges_m": list(scans.level_ranges)}
        pyarrow.parquet.write_table(pyarrow.table(level), folder / "horizontal.parquet")
    if poses:
        path = {"time_s": scans.times_s, "matrix": list(scans.world_from_vehicle.reshape(-1, 12))}
        pyarrow.parquet.write_table(pyarrow.table(path), folder / "path.parquet")
