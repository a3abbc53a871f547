"""Repeated meshes: written and read back, and written out one by one, against trimesh."""

from __future__ import annotations

import contextlib
import io
from pathlib import Path

import numpy as np
import pytest
import trimesh
from scipy.spatial.transform import Rotation

from veduta.formats.gltf import glb_bytes, read_glb
from veduta.formats.gltf_instances import INSTANCING, MOST_NODES, gltf_placement, part_placement
from veduta.place import flatten
from veduta.place.builder import PartBuilder
from veduta.place.flatten import TooManyTrianglesError, flattened
from veduta.place.instances import InstanceGroup, Instances, SharedMesh
from veduta.place.material import Material
from veduta.place.part import Part
from veduta.place.semantics import Provenance, SemanticClass
from veduta.run.errors import InputError

BOX = trimesh.creation.box(extents=(1.0, 0.5, 2.0))


def places(count: int) -> np.ndarray:
    rng = np.random.default_rng(3)
    turn = Rotation.random(count, rng=3).as_matrix()
    stretch = rng.uniform(0.3, 3.0, (count, 3))
    return np.concatenate([turn * stretch[:, None, :], rng.uniform(-9, 9, (count, 3, 1))], axis=2)


def shared() -> SharedMesh:
    return SharedMesh(
        name="box",
        positions_m=BOX.vertices.astype(np.float32),
        normals=BOX.vertex_normals.astype(np.float32),
        indices=BOX.faces.astype(np.uint32),
        slot=np.repeat([0, 1], [4, 8]).astype(np.int32),
        slots=("frame", "pane"),
    )


def part(count: int = 5, *, ground: bool = True) -> Part:
    builder = PartBuilder("house")
    if ground:
        row = builder.feature(SemanticClass.GROUND, Provenance.INVENTED, "ground")
        square = [(0, 0, 0), (4, 0, 0), (4, 3, 0), (0, 3, 0)]
        builder.polygon([square], row, builder.material(Material("ground")))
    rows = [
        builder.feature(SemanticClass.WINDOW, Provenance.INVENTED, f"window {k}")
        for k in range(count)
    ]
    numbers = [builder.material(Material(name, (0.2, k / 4, 0.6))) for k, name in enumerate("abc")]
    every, feature = places(count), np.array(rows, dtype=np.int32)
    groups = (
        InstanceGroup(0, (numbers[0], numbers[1]), every[:2], feature[:2]),
        InstanceGroup(0, (numbers[2], numbers[1]), every[2:], feature[2:]),
    )
    made = builder.build() if ground else _without_polygons(builder)
    return Part(**{**vars(made), "instances": Instances((shared(),), groups)})


def _without_polygons(builder: PartBuilder) -> Part:
    row = builder.feature(SemanticClass.GROUND, Provenance.INVENTED, "nothing")
    builder.polygon([[(0, 0, 0), (1, 0, 0), (0, 1, 0)]], row, 0)
    full = builder.build()
    none = np.zeros(1, dtype=np.int64)
    return Part(
        **{
            **vars(full),
            "positions_m": full.positions_m[:0],
            "uv": full.uv[:0],
            "ring_offsets": none,
            "polygon_offsets": none,
            "polygon_feature": full.polygon_feature[:0],
            "polygon_material": full.polygon_material[:0],
        }
    )


def moved(place: np.ndarray) -> trimesh.Trimesh:
    return BOX.copy().apply_transform(np.vstack([place, [0, 0, 0, 1]]))


def test_areas_and_bounds_are_those_of_the_meshes_in_place() -> None:
    found = part()
    boxes = [moved(place) for place in places(5)]
    assert found.feature_area_m2[1:] == pytest.approx([box.area for box in boxes], rel=1e-6)
    ends = np.concatenate([box.vertices for box in boxes])
    low, high = found.bounds_m
    assert low == pytest.approx(np.minimum(ends.min(axis=0), 0.0), abs=1e-5)
    assert high == pytest.approx(np.maximum(ends.max(axis=0), [4, 3, 0]), abs=1e-5)


def test_written_out_they_are_plain_polygons() -> None:
    whole, flat = part(), flattened(part())
    assert flat.instances is None
    assert len(flat.polygon_feature) == 1 + 5 * 12
    assert flat.feature_area_m2 == pytest.approx(whole.feature_area_m2, rel=1e-5)
    assert np.allclose(flat.bounds_m, whole.bounds_m, atol=1e-5)
    own = flat.polygon_material[flat.polygon_feature == 4]
    assert sorted(set(own.tolist())) == [2, 3]
    assert flattened(flat) is flat


def test_too_many_are_not_written_out(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(flatten, "MOST_TRIANGLES", 59)
    with pytest.raises(TooManyTrianglesError, match="60 triangles"):
        flattened(part())


@pytest.mark.parametrize("most_nodes", [0, 1000])
@pytest.mark.parametrize("ground", [True, False])
def test_a_file_gives_them_back(tmp_path: Path, ground: bool, most_nodes: int) -> None:
    whole = part(ground=ground)
    (tmp_path / "house.glb").write_bytes(glb_bytes(whole, most_nodes=most_nodes))
    back = read_glb(tmp_path / "house.glb")
    assert back.instances is not None
    assert back.features.id == whole.features.id
    assert back.feature_area_m2 == pytest.approx(whole.feature_area_m2, rel=1e-5)
    assert np.allclose(back.bounds_m, whole.bounds_m, atol=1e-4)
    assert len(back.instances.meshes) == 1
    wanted, found = flattened(whole), flattened(back)
    colour = [
        [one.materials[k].colour for k in one.polygon_material[-60:]] for one in (wanted, found)
    ]
    assert np.allclose(sorted(colour[0]), sorted(colour[1]), atol=1e-4)


@pytest.mark.parametrize(
    ("written", "broken"),
    [
        (b'{"veduta":{"instances":true}}', b'{"veduta": "instances: true"}'),
        (b'{"veduta":{"instances":true}}', b"null".ljust(29)),
        (b'{"veduta":{"instance":5}}', b'{"veduta":{"instance":9}}'),
        (b'{"veduta":{"instance":5}}', b'{"veduta":   "instance" }'),
    ],
)
def test_a_file_that_was_edited_is_refused_or_read_without_them(
    tmp_path: Path, written: bytes, broken: bytes
) -> None:
    """Never with a traceback."""
    data = glb_bytes(part())
    assert len(written) == len(broken)
    assert written in data
    path = tmp_path / "house.glb"
    path.write_bytes(data.replace(written, broken))
    with contextlib.suppress(InputError):
        assert read_glb(path).instances is None


def test_a_thousand_are_nodes_and_one_more_is_not() -> None:
    assert INSTANCING.encode() not in glb_bytes(part(MOST_NODES))
    assert INSTANCING.encode() in glb_bytes(part(MOST_NODES + 1))


def test_any_reader_sees_few_of_them_where_they_stand() -> None:
    """trimesh knows no extension for instances; its y is up, as glTF's."""
    data = glb_bytes(part())
    assert INSTANCING.encode() not in data
    scene = trimesh.load_scene(io.BytesIO(data), file_type="glb")
    found = scene.to_mesh()
    low, high = part().bounds_m
    assert found.bounds[0] == pytest.approx([low[0], low[2], -high[1]], abs=1e-4)
    assert found.bounds[1] == pytest.approx([high[0], high[2], -low[1]], abs=1e-4)
    boxes = sum(moved(place).area for place in places(5))
    assert found.area == pytest.approx(boxes + 12.0, rel=1e-5)


def test_placements_go_to_the_file_and_back() -> None:
    every = places(40)
    assert np.allclose(part_placement(*gltf_placement(every)), every, atol=1e-5)
    move, turn, stretch = gltf_placement(every)
    # glTF's own composition, of a point given in its frame: (x, z, -y).
    point = np.array([0.3, -0.7, 1.1])
    truth = every[:, :, :3] @ point + every[:, :, 3]
    there = np.array([point[0], point[2], -point[1]])
    composed = Rotation.from_quat(turn).apply(stretch * there) + move
    assert np.allclose(composed, truth[:, [0, 2, 1]] * [1, 1, -1], atol=1e-4)
