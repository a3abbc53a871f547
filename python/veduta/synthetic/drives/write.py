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

[path]
table = "path.parquet"
"""


def write_drive(scans: DriveScans, folder: Path, name: str = "drive") -> None:
    """Write into a folder, which is made."""
    folder.mkdir(parents=True, exist_ok=True)
    angles = scans.angles_rad
    text = _TOML.format(
        name=name, height=scans.options.height_m, first=float(angles[0]),
        step=float(angles[1] - angles[0]), farthest=scans.options.farthest_m,
    )  # fmt: skip
    (folder / "drive.toml").write_text(text, encoding="utf-8")
    rows = {"time_s": scans.times_s, "ranges_m": list(scans.ranges)}
    pyarrow.parquet.write_table(pyarrow.table(rows), folder / "vertical.parquet")
    poses = {"time_s": scans.times_s, "matrix": list(scans.world_from_vehicle.reshape(-1, 12))}
    pyarrow.parquet.write_table(pyarrow.table(poses), folder / "path.parquet")
