"""Files that all blocks of a derived town have together, beside its tree of tiles."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from pathlib import Path

from veduta.formats.ground_glb import ground_glb
from veduta.formats.tiles import Box, union
from veduta.grammar.ground_regions import grounds_of
from veduta.grammar.report import Whole
from veduta.grammar.reported import FILE as REPORTS
from veduta.grammar.squares import Squares
from veduta.grammar.textures import with_builtin
from veduta.grammar.tile_pictures import picture_files

GROUND = "ground"


def write_pictures(work: Path, textures: Mapping[str, str], whole: Whole) -> None:
    """The pictures that tiles show, once for all of them."""
    shown = {name for _, summary in whole.blocks for name in summary["pictures"]}
    for file, data in picture_files(with_builtin(textures), sorted(shown)).items():
        (work / file).parent.mkdir(exist_ok=True)
        (work / file).write_bytes(data)


def tables(out: Path, whole: Whole) -> list[Path]:
    """The tables of what rules reported, of the blocks that have one."""
    return [out / name / REPORTS for name, summary in whole.blocks if summary["tabled"]]


def write_ground(work: Path, squares: Squares, done: Collection[str]) -> dict[str, tuple[str, Box]]:
    """The ground of each block that is done, seen from its origin: its file and box."""
    found = {}
    origins = {square.name: square.origin_m for square in squares.every}
    for name, ground in grounds_of(squares).items():
        if name not in done:
            continue
        file = f"{GROUND}/{name.rpartition('/')[2]}.glb"
        points = ground.points_m - origins[name]
        (work / file).parent.mkdir(exist_ok=True)
        (work / file).write_bytes(ground_glb(points, ground.triangles))
        low, high = points.min(axis=0).tolist(), points.max(axis=0).tolist()
        found[name] = (file, union([((low[0], low[1], low[2]), (high[0], high[1], high[2]))]))
    return found
