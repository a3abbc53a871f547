"""The model of an animal with limbs: skin, clips, coat, and the command's own refusals."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from test_limbs import small_limbed

from veduta.fauna.build.limbed import build_limbed
from veduta.fauna.document.plan import load_plan
from veduta.fauna.limbed_recipe import plan_for
from veduta.fauna.options import AnimalOptions, FaunaOptions
from veduta.fauna.recipe import Record
from veduta.run.errors import InputError


def test_the_skin_is_closed_and_its_root_goes_by_the_stride() -> None:
    animal = small_limbed()
    built = build_limbed(animal)
    mesh = built.mesh
    assert mesh.skin is not None
    assert mesh.skin.names[0] == "root"
    # Vertices stand twice at the coat's seam: by their places every edge has two triangles.
    _, place = np.unique(mesh.positions_m.round(7), axis=0, return_inverse=True)
    faces = place[mesh.triangles.astype(np.int64)]
    edges = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    _, count = np.unique(edges, axis=0, return_counts=True)
    assert (count == 2).mean() > 0.999
    walk = mesh.clips[0]
    assert walk.name == "walk"
    assert walk.loops
    assert walk.translations_m[-1, 0, 0] == pytest.approx(0.4 * 0.9)
    np.testing.assert_allclose(walk.rotations_xyzw[0], walk.rotations_xyzw[-1], atol=1e-9)
    low, high = mesh.positions_m.min(axis=0), mesh.positions_m.max(axis=0)
    assert abs(low[2]) < 0.02
    assert high[0] - low[0] > 0.9 * 0.9
    assert abs(low[1] + high[1]) < 0.01


def test_what_was_not_seen_is_marked_as_invented() -> None:
    mesh = build_limbed(small_limbed()).mesh
    left = mesh.positions_m[mesh.triangles][..., 1].mean(axis=1) > 0.01
    assert (mesh.triangle_feature[~left & (mesh.triangle_feature == 0)]).size < 0.04 * len(left)
    assert (mesh.triangle_feature[left] == 0).mean() > 0.5


def test_a_view_that_the_plan_does_not_have_is_refused() -> None:
    options = FaunaOptions(animal=AnimalOptions(kind="quadruped", view="top"))
    with pytest.raises(InputError, match="one from the side"):
        plan_for(Record(Path("dog.mp4")), options)
    options = FaunaOptions(animal=AnimalOptions(kind="lizard", view="top"))
    assert plan_for(Record(Path("x.mp4")), options) == load_plan("lizard")
