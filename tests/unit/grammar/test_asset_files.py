"""Assets from files: read as other programs read them, and refused with the reason."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

from veduta import _core
from veduta.grammar.assets.from_file import read_asset
from veduta.grammar.assets.library import Library
from veduta.run.errors import InputError

WEDGE = """mtllib wedge.mtl
v 0 0 0
v 2 0 0
v 2 0 1
v 0 0 1
v 0 1 0
v 2 1 0
v 9 9 9
usemtl red
f 1 2 3 4
f 1/1/1 5 6 2
usemtl plain
f -4 -5 -3 -2
f 1 4 5
f 2 6 3
f 1 1 2
"""


def write(folder: Path, name: str, text: str) -> None:
    (folder / name).parent.mkdir(parents=True, exist_ok=True)
    (folder / name).write_text(text)


def area(points: np.ndarray, triangles: np.ndarray) -> float:
    return float(
        trimesh.Trimesh(
            points[triangles].reshape(-1, 3),
            np.arange(triangles.size).reshape(-1, 3),
            process=False,
        ).area
    )


def test_an_obj_file(tmp_path: Path) -> None:
    write(tmp_path, "things/wedge.obj", WEDGE.replace("f -4 -5 -3 -2", "f 3 6 5 4"))
    write(tmp_path, "things/wedge.mtl", "newmtl red\nKd 1 0.5 0\n")
    asset = read_asset("things/wedge.obj", tmp_path / "things/wedge.obj")
    # A prism on a right triangle of 1 m by 1 m, 2 m long; the point that no face uses is gone.
    assert asset.box_m.tolist() == [[0, 0, 0], [2, 1, 1]]
    assert len(asset.offsets) - 1 == 5
    indices, _, _ = asset.triangles
    truth = 2.0 + 2.0 + 2.0 * np.sqrt(2.0) + 1.0
    assert area(asset.points_m[asset.corners], indices) == pytest.approx(truth)
    assert [(slot.name, slot.colour) for slot in asset.slots] == [
        ("red", (1.0, 0.5, 0.0)),
        ("plain", None),
    ]


def test_a_warped_face_becomes_triangles(tmp_path: Path) -> None:
    write(tmp_path, "warped.obj", "v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0.5 1\nf 1 2 3 4\n")
    assert len(read_asset("warped.obj", tmp_path / "warped.obj").offsets) - 1 == 2


def test_a_glb_file(tmp_path: Path) -> None:
    scene = trimesh.Scene()
    mesh = trimesh.creation.icosphere(subdivisions=1, radius=0.5)
    mesh.visual = trimesh.visual.TextureVisuals(
        material=trimesh.visual.material.PBRMaterial(
            name="gold", baseColorFactor=[1.0, 0.5, 0.0, 1.0]
        )
    )
    scene.add_geometry(mesh, transform=trimesh.transformations.translation_matrix([0, 2, 0]))
    (tmp_path / "ball.glb").write_bytes(scene.export(file_type="glb"))
    asset = read_asset("ball.glb", tmp_path / "ball.glb")
    indices, _, _ = asset.triangles
    assert area(asset.points_m[asset.corners], indices) == pytest.approx(float(mesh.area), rel=1e-5)
    assert asset.box_m.mean(axis=0) == pytest.approx([0.0, 2.0, 0.0], abs=1e-6)
    assert asset.slots[0].name == "gold"
    red, green, blue = asset.slots[0].colour or (0, 0, 0)
    assert (red, blue) == (1.0, 0.0)
    assert green == pytest.approx(0.735, abs=0.005)  # 0.5, linear


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("v 0 0 0\nf 1 2 3\n", "line 2"),
        ("v 0 0\n", "line 1"),
        ("v 0 0 0\nv 1 0 0\nf 1 2\n", "fewer than three"),
        ("v 0 0 0\n", "no faces"),
        ("v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "no numbers"),
        ("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "area"),
    ],
)
def test_faults_of_obj_files(tmp_path: Path, text: str, told: str) -> None:
    write(tmp_path, "bad.obj", text)
    with pytest.raises(InputError, match=told) as fault:
        read_asset("bad.obj", tmp_path / "bad.obj")
    assert "bad.obj" in str(fault.value)


def test_nothing_outside_of_the_folder_is_read(tmp_path: Path) -> None:
    write(tmp_path, "out.obj", WEDGE)
    write(tmp_path, "rules/in.txt", "")
    (tmp_path / "rules" / "link.obj").symlink_to(tmp_path / "out.obj")
    library = Library(tmp_path / "rules")
    for name in ("../out.obj", "link.obj", str(tmp_path / "out.obj"), "none.obj"):
        with pytest.raises(InputError, match="does not exist in any folder"):
            library[name]


@settings(max_examples=60, deadline=None)
@given(data=st.binary(max_size=200))
def test_any_bytes_are_read_or_refused(
    data: bytes, tmp_path_factory: pytest.TempPathFactory
) -> None:
    folder = tmp_path_factory.mktemp("any")
    for name, head in (
        ("any.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
        ("any.glb", b"glTF\2\0\0\0"),
    ):
        (folder / name).write_bytes(head + data)
        try:
            asset = read_asset(name, folder / name)
        except InputError:
            continue
        assert np.isfinite(asset.points_m).all()


def test_names_that_there_are_not(tmp_path: Path) -> None:
    library = Library(tmp_path)
    with pytest.raises(InputError, match="window-casement"):
        library["builtin/window-casment"]
    with pytest.raises(InputError, match="OBJ, GLB or COLLADA"):
        library["window"]


def test_a_changed_file_changes_the_digest(tmp_path: Path) -> None:
    def digest(rules: str) -> str:
        return Library(tmp_path).digest(_core.GrammarRules([("test.cga", rules)]))

    wedge = WEDGE.replace("f -4 -5 -3 -2", "f 3 6 5 4")
    for rules in ('Lot --> i("a.obj")', 'attr n = "a"\nLot --> i(n + ".obj")'):
        write(tmp_path, "a.obj", wedge)
        before = digest(rules)
        assert digest(rules) == before
        write(tmp_path, "out/.veduta/record.json", "")
        write(tmp_path, "out/parts/made.glb", "")
        assert digest(rules) == before
        write(tmp_path, "a.obj", wedge.replace("v 2 0 1\n", "v 2 0 1.5\n"))
        assert digest(rules) != before
