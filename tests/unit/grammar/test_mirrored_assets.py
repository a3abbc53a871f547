"""Assets that rules mirror or turn inside out: their materials, and a second reader's view."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import trimesh
from numpy.typing import NDArray

from veduta.formats.place_glb import write_place_glb
from veduta.grammar.building import build_part
from veduta.grammar.deriving import deriver
from veduta.grammar.levels import FULL
from veduta.grammar.one_lot import plain_lot
from veduta.grammar.options import GrammarOptions
from veduta.grammar.project import SearchPath
from veduta.place.part import Part
from veduta.place.place import Place

WEDGE = """mtllib wedge.mtl
usemtl red
v 0 0 0
v 2 0 0
v 2 0 1
v 0 0 1
v 0 3 0
v 1 3 0
v 1 3 1
v 0 3 1
f 1 2 3 4
f 1 5 6 2
f 1 4 8 5
usemtl blue
f 4 3 7 8
f 3 2 6 7
f 5 8 7 6
"""
"""2 m wide at the foot and 1 m at the top, 3 m high and 1 m deep: 4.5 m3."""
MATERIALS = "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n"
MADE = {
    "as it is": ("", 4.5),
    "mirrored": ("mirror(true, false, false)", 4.5),
    "mirrored by its size": ("s(-2, '1, '1)", -4.5),
    "inside out": ("reverseNormals()", -4.5),
    "turned by two signs": ("s(-2, '1, -1)", 4.5),
}


def built(folder: Path, operations: str) -> Part:
    (folder / "wedge.obj").write_text(WEDGE)
    (folder / "wedge.mtl").write_text(MATERIALS)
    rules = f'Lot --> t(3, 0, 4) s(2, 3, 1) i("wedge.obj") {operations} Wedge.'
    by = deriver((("rules.cga", rules),), SearchPath.of(folder), GrammarOptions())
    columns = by.together([plain_lot(20, 30)], FULL).columns(0)
    assert len(columns.positions_m) == 0
    return build_part(columns, "wedge", by.library.assets_of(columns))


def corners_of(part: Part) -> dict[tuple[float, ...], NDArray[np.float64]]:
    """The triangles (n, 3, 3) of each colour, in the frame of the part (m)."""
    assert part.instances is not None
    (group,) = part.instances.groups
    mesh = part.instances.meshes[group.mesh]
    (place,) = group.part_from_mesh
    points = mesh.positions_m.astype(np.float64) @ place[:, :3].T + place[:, 3]
    return {
        part.materials[material].colour: points[mesh.indices[mesh.slot == slot]]
        for slot, material in enumerate(group.materials)
    }


def volume_m3(corners: NDArray[np.float64]) -> float:
    a, b, c = corners.transpose(1, 0, 2)
    return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6.0)


@pytest.mark.parametrize("name", MADE)
def test_materials_stay_where_they_are_in_the_mesh(tmp_path: Path, name: str) -> None:
    operations, volume = MADE[name]
    found = corners_of(built(tmp_path, operations))
    assert set(found) == {(1.0, 0.0, 0.0), (0.0, 0.0, 1.0)}
    every = np.concatenate(list(found.values()))
    assert volume_m3(every) == pytest.approx(volume, abs=1e-5)
    # The foot is red: 2 m by 1 m at the lowest height.
    red = found[1.0, 0.0, 0.0]
    foot = red[np.ptp(red[:, :, 2], axis=1) < 1e-6]
    sides = foot[:, 1:] - foot[:, :1]
    area = np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1).sum() / 2
    assert area == pytest.approx(2.0, abs=1e-5)


def test_the_slope_of_a_mirror_image_is_on_the_other_side(tmp_path: Path) -> None:
    def top(name: str) -> tuple[float, float]:
        every = np.concatenate(list(corners_of(built(tmp_path, MADE[name][0])).values()))
        high = every[every[..., 2] > every[..., 2].max() - 1e-6]
        low = every[..., 0].min()
        return (round(high[:, 0].min() - low, 5), round(high[:, 0].max() - low, 5))

    assert top("as it is") == (0.0, 1.0)
    assert top("mirrored") == (1.0, 2.0)
    assert top("mirrored by its size") == (1.0, 2.0)
    assert top("inside out") == (0.0, 1.0)
    assert top("turned by two signs") == (1.0, 2.0)


def test_other_programs_see_the_mirror_image(tmp_path: Path) -> None:
    part = built(tmp_path, "mirror(true, false, false)")
    path = tmp_path / "wedge.glb"
    place = Place()
    place.add(part)
    write_place_glb(place, path)
    scene = trimesh.load(path, force="scene")
    mesh = scene.to_geometry()
    assert mesh.volume == pytest.approx(4.5, abs=1e-4)
