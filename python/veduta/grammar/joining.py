"""Files that all blocks of a derived town have together, beside its tree of tiles."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from pathlib import Path

from veduta.formats.cityjson_text import relief_line
from veduta.formats.ground_glb import ground_glb
from veduta.formats.tile_glb import BuildingRow
from veduta.formats.tiles import Box
from veduta.grammar.ground import Ground
from veduta.grammar.ground_part import COLOUR, NAME, ground_part
from veduta.grammar.ground_regions import grounds_of
from veduta.grammar.report import Whole
from veduta.grammar.reported import FILE as REPORTS
from veduta.grammar.squares import Squares
from veduta.grammar.textures import WHITE, with_builtin
from veduta.grammar.tile_pictures import picture_files
from veduta.place.place import ModelFile, Place
from veduta.run.atomic import write_bytes

GROUND = "ground"


def write_pictures(work: Path, textures: Mapping[str, str], whole: Whole) -> None:
    """The pictures that tiles and CityJSON show, once for all of them."""
    shown = {(name, WHITE) for _, summary in whole.blocks for name in summary["pictures"]}
    for _, summary in whole.blocks:
        shown |= {(name, (red, green, blue)) for name, (red, green, blue) in summary["tinted"]}
    for file, data in picture_files(with_builtin(textures), sorted(shown)).items():
        (work / file).parent.mkdir(exist_ok=True)
        (work / file).write_bytes(data)


def tables(out: Path, whole: Whole) -> list[Path]:
    """The tables of what rules reported, of the blocks that have one."""
    return [out / name / REPORTS for name, summary in whole.blocks if summary["tabled"]]


@dataclass(frozen=True)
class GroundFiles:
    """The ground of a block, and where it is stored: paths in OUT.

    box: around it, seen from the block's origin. model: a glTF file for the place; None where the
    tile is all that there is.
    """

    ground: Ground
    box: Box
    tile: str
    model: str | None


def write_ground(
    work: Path, squares: Squares, done: Collection[str], *, separate: bool
) -> dict[str, GroundFiles]:
    """The ground of each block that is done, by the block's name."""
    found = {}
    origins = {square.name: square.origin_m for square in squares.every}
    for name, ground in grounds_of(squares).items():
        if name not in done:
            continue
        (work / GROUND).mkdir(exist_ok=True)
        number = _number(name)
        points = ground.points_m - origins[name]
        row = BuildingRow(GROUND, NAME)
        tile, model = f"{GROUND}/{number}.glb", f"{GROUND}/{number}-model.glb"
        write_bytes(work / tile, ground_glb(points, ground.triangles, row, COLOUR))
        part = ground_part(part_id(name), points, ground.triangles)
        has_model = separate and len(part.positions_m) > 0
        if has_model:
            Place().add(part, file=ModelFile(model)).save(work)
        low, high = points.min(axis=0).tolist(), points.max(axis=0).tolist()
        box = (low[0], low[1], low[2]), (high[0], high[1], high[2])
        found[name] = GroundFiles(ground, box, tile, model if has_model else None)
    return found


def part_id(block: str) -> str:
    """What the ground of a block is called in the place: no lot's name has a colon."""
    return f"{GROUND}:{_number(block)}"


def _number(block: str) -> str:
    """The last part of a block's path."""
    return block.rpartition("/")[2]


def write_ground_city(path: Path, grounds: Mapping[str, GroundFiles]) -> None:
    """The ground between the lots as lines of CityJSON."""
    lines = []
    for name, files in grounds.items():
        ground = files.ground
        between = ground.triangles[: ground.between]
        if len(between):
            lines.append(relief_line(part_id(name), ground.points_m, between))
    write_bytes(path, "".join(f"{line}\n" for line in lines).encode())
