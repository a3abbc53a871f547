"""The front without what stands before it: what is taken out, what is filled, what is evened."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from sample_document import element, sample_document, sample_photo

from veduta.facade.cleared import BEFORE, KINDS, before_png, hidden_kinds, load_before
from veduta.facade.cleared.light import even_light
from veduta.facade.cleared.repeats import own_repeats
from veduta.facade.eyes import Seen
from veduta.facade.model import build_part
from veduta.facade.textures import make_textures
from veduta.place.semantics import SemanticClass
from veduta.run.errors import InputError


def seen_of(kind: str, rows: slice, columns: slice, chance: float = 0.9) -> Seen:
    """A picture of 200 x 100 px in which one thing is seen, and wall else."""
    names = ("wall", *KINDS[1:])
    classes = np.zeros((len(names), 50, 100), np.float32)
    classes[0] = 1.0
    classes[names.index(kind), rows, columns] = chance
    empty = np.zeros((0, 25, 50), np.float32)
    return Seen(names, (), classes, empty, empty, 1.0, 1.0, 200, 100)


def test_a_vehicle_on_the_ground_is_before_the_front() -> None:
    kinds = hidden_kinds(seen_of("vehicle", slice(35, 50), slice(20, 60)))
    assert kinds.shape == (100, 200)
    assert (kinds[70:100, 40:120] == KINDS.index("vehicle")).all()
    assert (kinds > 0).sum() == 30 * 80


def test_what_hangs_in_the_air_is_unsure_or_tiny_is_not() -> None:
    assert not hidden_kinds(seen_of("vehicle", slice(5, 15), slice(20, 60))).any()
    assert not hidden_kinds(seen_of("tree", slice(5, 15), slice(20, 60), 0.5)).any()
    assert not hidden_kinds(seen_of("tree", slice(5, 6), slice(20, 22))).any()
    assert hidden_kinds(seen_of("tree", slice(5, 15), slice(20, 60))).any()


def test_offsets_of_a_grid_of_windows() -> None:
    x, y = np.meshgrid(np.arange(4) * 60.0 + 10, np.arange(3) * 80.0 + 5)
    boxes = np.stack([x.ravel(), y.ravel(), x.ravel() + 24, y.ravel() + 40], axis=1)
    found = own_repeats(boxes)
    steps = {tuple(step) for step in found.offsets.tolist()}
    assert {(60, 0), (-60, 0), (0, 80), (0, -80), (60, 80)} <= steps
    assert all(dx % 60 == 0 and dy % 80 == 0 for dx, dy in steps)
    assert found.storey_px == 80.0
    assert len(own_repeats(boxes[:1]).offsets) == 0


def test_what_is_before_the_wall_is_filled_and_marked() -> None:
    document = sample_document([element("window", 2.0, 1.0, 1.0, 1.5)])
    photo = sample_photo(document)
    before = np.zeros(photo.shape[:2], np.uint8)
    before[-40:, 30:70] = KINDS.index("tree")
    bare = make_textures(document, photo, document.facade.height_m)
    made = make_textures(document, photo, document.facade.height_m, before)
    assert not bare.wall.invented.any()
    assert made.wall.invented.any()
    assert set(made.cleared.shares) == {"tree"}
    assert not made.front.invented.any()


def test_what_is_nearly_all_hidden_stays_and_that_is_said() -> None:
    document = sample_document([element("window", 2.0, 1.0, 1.0, 1.5)])
    photo = sample_photo(document)
    before = np.full(photo.shape[:2], KINDS.index("tree"), np.uint8)
    made = make_textures(document, photo, document.facade.height_m, before)
    assert made.cleared.shares == {}
    assert not made.wall.invented.any()
    assert "hidden" in made.cleared.notes[0]


def test_a_gradient_of_light_is_evened_on_the_wall_alone() -> None:
    fall = np.linspace(1.0, 0.6, 300)[None, :, None]
    pixels = np.broadcast_to(200 * fall, (200, 300, 3)).astype(np.uint8)
    wall = np.ones((200, 300), dtype=np.bool_)
    made, change = even_light(pixels, wall, slice(50, 200), 60.0)
    before, after = pixels[120].astype(float), made[120].astype(float)
    assert np.ptp(after) < 0.6 * np.ptp(before)
    assert 0.05 < change < 0.36
    np.testing.assert_array_equal(made[:40], pixels[:40])
    same, none = even_light(pixels, ~wall, slice(50, 200), 60.0)
    assert none == 0.0
    np.testing.assert_array_equal(same, pixels)


def test_before_png_comes_back_and_bad_ones_are_named(tmp_path: Path) -> None:
    kinds = np.zeros((10, 20), np.uint8)
    kinds[5:, 3:9] = 4
    document = tmp_path / "facade.json"
    assert not load_before(document, (20, 10)).any()
    (tmp_path / BEFORE).write_bytes(before_png(kinds))
    np.testing.assert_array_equal(load_before(document, (20, 10)), kinds)
    with pytest.raises(InputError, match="is 20 x 10 px, the photo 21 x 10 px"):
        load_before(document, (21, 10))
    Image.fromarray(np.full((10, 20), 9, np.uint8)).save(tmp_path / BEFORE)
    with pytest.raises(InputError, match="has the class 9"):
        load_before(document, (20, 10))
    Image.fromarray(np.zeros((10, 20, 3), np.uint8)).save(tmp_path / BEFORE)
    with pytest.raises(InputError, match="has colours and no classes"):
        load_before(document, (20, 10))
    (tmp_path / BEFORE).write_bytes(b"no picture")
    with pytest.raises(InputError, match="cannot be read as PNG"):
        load_before(document, (20, 10))


def test_panes_are_glass_and_no_wall() -> None:
    document = sample_document([element("window", 2.0, 4.0, 1.0, 1.5)])
    part = build_part(document, sample_photo(document), "house")
    panes = [
        part.features.semantic(row) is SemanticClass.WINDOW for row in range(len(part.features))
    ]
    of_window = (
        np.array(panes)[part.polygon_feature]
        & ~np.array(["reveal" in name for name in part.features.name])[part.polygon_feature]
    )
    used = {part.materials[n] for n in part.polygon_material[of_window].tolist()}
    assert {material.name for material in used} == {"window"}
    assert max(material.roughness for material in used) < 0.5
