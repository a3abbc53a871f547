"""The mesh, its skin and its clips, and the document that they are built from."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from swimming import sample_animal

from veduta.fauna.build.body import slices_along
from veduta.fauna.build.build import build_animal, goer_of
from veduta.fauna.build.going import Goer, place_of
from veduta.fauna.build.into_place import place_into
from veduta.fauna.document.load import load_animal, save_animal
from veduta.fauna.motion.angles import axis_of
from veduta.fauna.options import MotionOptions
from veduta.place.manifest import IDENTITY, Walk, WalkKey
from veduta.place.mesh import Mesh
from veduta.place.place import Place, Standing
from veduta.place.skin import Clip
from veduta.run.errors import InputError


def posed(mesh: Mesh, clip: Clip, row: int) -> np.ndarray:
    """Linear blend skinning by hand: (v, 3)."""
    skin = mesh.skin
    assert skin is not None
    world = np.tile(np.eye(4), (len(skin.names), 1, 1))
    for joint, parent in enumerate(skin.parent):
        local = np.eye(4)
        local[:3, :3] = Rotation.from_quat(clip.rotations_xyzw[row, joint]).as_matrix()
        local[:3, 3] = clip.translations_m[row, joint]
        world[joint] = local if parent < 0 else world[parent] @ local
    moved = world @ np.linalg.inv(skin.rest)
    points = np.c_[mesh.positions_m, np.ones(len(mesh.positions_m))]
    every = np.einsum("vkab,vb->vka", moved[skin.joints], points)[..., :3]
    return (skin.weights[..., None] * every).sum(axis=1)


@pytest.mark.parametrize("kind", ["fish", "snake", "worm"])
def test_the_mesh_is_closed_and_looks_outwards(kind: str) -> None:
    mesh = build_animal(sample_animal(kind), MotionOptions(seconds=1.0, states=20)).mesh
    corners = mesh.positions_m[mesh.triangles].astype(float)
    middle = np.array([0.0, 0.0, corners[..., 2].mean()])
    volume = np.einsum(
        "ij,ij->i", corners[:, 0] - middle, np.cross(corners[:, 1] - middle, corners[:, 2] - middle)
    )
    assert volume.sum() > 0.0
    ring = corners[np.abs(corners[..., 0]).max(axis=1) < 0.1]
    out = np.cross(ring[:, 1] - ring[:, 0], ring[:, 2] - ring[:, 0])
    assert ((ring.mean(axis=1) - middle)[:, 1:] * out[:, 1:]).sum(axis=1).min() > 0.0


def test_slices_are_the_document_s() -> None:
    animal = sample_animal()
    places, wide, high = slices_along(animal)
    for piece in animal.body.slices[15:-1:9]:
        assert np.interp(piece.at, places, wide) / 0.5 == pytest.approx(piece.half_width, rel=0.02)
        assert np.interp(piece.at, places, high) / 0.5 == pytest.approx(piece.half_height, rel=0.02)
    assert wide[0] == 0.0


def test_a_clip_puts_the_skin_around_the_axis() -> None:
    animal = sample_animal()
    built = build_animal(animal, MotionOptions(seconds=1.0, states=20))
    for gait, clip in zip(built.gaits, built.mesh.clips, strict=True):
        row = len(clip.times_s) // 3
        rings = posed(built.mesh, clip, row).reshape(-1, 29, 3)[:, :-1].mean(axis=1)
        axis = (axis_of(gait.angles[row : row + 1])[0] + gait.middle[row]) * 0.5
        apart = np.linalg.norm(rings[:, None, :2] - axis[None], axis=2).min(axis=1)
        assert apart.max() < 0.006 * 0.5


def test_loops_close_but_for_the_stride() -> None:
    built = build_animal(sample_animal(), MotionOptions(seconds=1.0, states=20))
    for gait, clip in zip(built.gaits, built.mesh.clips, strict=True):
        assert clip.loops == gait.loops
        if not clip.loops:
            continue
        first, last = posed(built.mesh, clip, 0), posed(built.mesh, clip, -1)
        assert np.allclose(last - first, [gait.stride * 0.5, 0.0, 0.0], atol=2e-6)


def test_the_swimming_clip_is_a_period_of_the_wave() -> None:
    built = build_animal(sample_animal(), MotionOptions(seconds=1.0, states=20))
    assert built.gaits[0].name == "swim"
    assert built.gaits[0].times_s[-1] == pytest.approx(0.5, rel=0.01)


def test_the_document_comes_back_as_it_was(tmp_path: Path) -> None:
    animal = sample_animal()
    save_animal(animal, tmp_path / "animal.json")
    again = load_animal(tmp_path / "animal.json")
    assert again.model_dump(exclude={"motion"}) == animal.model_dump(exclude={"motion"})
    assert np.allclose(again.motion.columns(), animal.motion.columns(), atol=1e-8)


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("{", "Invalid JSON"),
        ('{"schema": "veduta/plan"}', "schema"),
        ("[]", "is no animal document"),
    ],
)
def test_bad_documents_are_refused(tmp_path: Path, text: str, fault: str) -> None:
    path = tmp_path / "animal.json"
    path.write_text(text)
    with pytest.raises(InputError, match=fault):
        load_animal(path)


def test_a_place_keeps_its_animals(tmp_path: Path) -> None:
    animal = sample_animal()
    place = place_of(goer_of(animal, build_animal(animal, MotionOptions(seconds=1.0, states=20))))
    place.save(tmp_path)
    again = Place.load(tmp_path)
    assert again.animals == place.animals
    content = again.parts["eel"].content
    assert isinstance(content, Mesh)
    assert content.skin is not None
    assert [clip.name for clip in content.clips] == ["swim", "roam", "footage"]


def _into(place: Place, goer: Goer, path: np.ndarray) -> Place:
    return place_into(place, goer, goer.along(path, closed=False))


def test_an_animal_in_a_place_leaves_the_place_its_files(tmp_path: Path) -> None:
    animal = sample_animal()
    built = build_animal(animal, MotionOptions(seconds=1.0, states=20))
    key = WalkKey(
        id="k", picture="walk/k.jpg", width_px=4, height_px=3, focal_px=(2.0, 2.0),
        centre_px=(2.0, 1.5), transform=IDENTITY,
    )  # fmt: skip
    walk = Walk(id="w", name="w", document="walk.json", keys=[key], transitions=[])
    place, folder = Place(walks=[walk]), tmp_path / "place"
    (folder / "walk").mkdir(parents=True)
    for name in place.names():
        (folder / name).write_text(name)
    place.save(folder)
    path = np.array([[0.0, 0.0, 0.0], [5.0, 0.0, 0.0]])
    into = _into(Place.load(folder), goer_of(animal, built), path)
    into.save(tmp_path / "out")
    assert (tmp_path / "out/walk/k.jpg").read_text() == "walk/k.jpg"
    assert (tmp_path / "out/walk.json").read_text() == "walk.json"


@pytest.mark.parametrize("twice", [False, True])
def test_another_animal_keeps_its_document(tmp_path: Path, twice: bool) -> None:
    animal = sample_animal()
    built = build_animal(animal, MotionOptions(seconds=1.0, states=20))
    first = built.mesh if twice else replace(built.mesh, id="other")
    place, folder, out = Place(), tmp_path / "place", tmp_path / "out"
    place.add(first, Standing(document="animal.json"))
    for where in (folder, out):
        where.mkdir()
        (where / "animal.json").write_text(where.name)
    place.save(folder)
    path = np.array([[0.0, 0.0, 0.0], [5.0, 0.0, 0.0]])
    _into(Place.load(folder), goer_of(animal, built), path).save(out)
    told = {
        name: (out / str(part.standing.document)).read_text()
        for name, part in Place.load(out).parts.items()
    }
    assert told == ({"eel": "out"} if twice else {"other": "place", "eel": "out"})
