"""A second view: heights of what was seen from above, widths of what was seen from the side."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

from veduta.fauna.document.plan import load_plan
from veduta.fauna.document.schema import Source
from veduta.fauna.options import FaunaOptions
from veduta.fauna.read.second_silhouettes import SilhouettePictures, read_second_view
from veduta.fauna.read.second_view import SecondLooks, SecondView, rounded, thickness
from veduta.fauna.read.tracked import Tracked, describe
from veduta.run.errors import InputError, NotFoundError

SOURCE = Source(file="a.avi", sha256="", frames=8, used=8)
ALONG = np.linspace(0.0, 1.0, 101)
HIGH = 0.012 + 0.06 * np.sin(np.pi * ALONG**0.6)
"""Half of how high the animal is along it: thickest well before its middle; in lengths."""


def side_view(length_px: float, *, flat: bool, turned: bool = False) -> NDArray[np.bool_]:
    """Its silhouette from the side; flat: its belly is straight, so that no slice is an ellipse."""
    shape = (int(0.4 * length_px), int(1.2 * length_px))
    x = 0.1 * length_px + length_px * ALONG
    middle = 0.5 * shape[0]
    up, down = (2.0 * HIGH, np.zeros_like(HIGH)) if flat else (HIGH, HIGH)
    back = np.stack([x, middle - up * length_px], axis=1)
    belly = np.stack([x, middle + down * length_px], axis=1)
    outline = np.concatenate([back, belly[::-1]])
    mask = np.zeros(shape, np.uint8)
    cv2.fillPoly(mask, [np.round(outline * 16).astype(np.int32)], 1, cv2.LINE_8, 4)
    return (mask[:, ::-1] if turned else mask) > 0


@pytest.mark.parametrize("flat", [False, True])
@pytest.mark.parametrize("turned", [False, True])
def test_how_high_it_is(flat: bool, turned: bool) -> None:
    view = SecondView((side_view(500.0, flat=flat, turned=turned),), "side.png")
    across = thickness(view, 0.7 * HIGH, SecondLooks())
    inside = slice(8, 93)  # the axis begins at the tips, which are round
    assert across.half[inside] == pytest.approx(HIGH[inside], rel=0.1)
    assert across.is_sure
    assert across.score > 0.95


def test_silhouettes_of_several_sizes_agree() -> None:
    masks = tuple(side_view(size, flat=False) for size in (300.0, 700.0))
    across = thickness(SecondView(masks, "sides"), HIGH, SecondLooks())
    assert across.half[5:96] == pytest.approx(HIGH[5:96], rel=0.1)


def test_the_document_has_them_as_measured() -> None:
    time = np.arange(8)[:, None]
    wave = 0.05 * np.sin(2.0 * np.pi * (ALONG[None] - 0.1 * time))
    points = np.stack([-(ALONG[None] - 0.02 * time) * 300.0, 300.0 * wave], axis=-1)
    half = np.repeat((300.0 * 0.7 * HIGH)[None], 8, axis=0)
    tracked = Tracked(points, np.arange(8), 0.04, "px", half, ())
    alone = describe(tracked, "a", SOURCE, FaunaOptions()).animal
    assert alone.body.heights == "invented"
    assert any("--second-view" in doubt for doubt in alone.doubts)
    view = SecondView((side_view(500.0, flat=False),), "side.png")
    body = describe(tracked, "a", SOURCE, FaunaOptions(), view).animal.body
    assert (body.widths, body.heights) == ("measured", "measured")
    for piece in body.slices[8:-8]:
        assert piece.half_height == pytest.approx(np.interp(piece.at, ALONG, HIGH), rel=0.12)


@pytest.mark.parametrize("kind", ["quadruped", "lizard"])
@pytest.mark.parametrize("wide", [0.5, 1.3])
@pytest.mark.parametrize("turned", [False, True])
def test_how_wide_one_with_legs_is(kind: str, wide: float, turned: bool) -> None:
    """Seen from the other side: its trunk with a head, a leg that stands off, and a tail."""
    plan = load_plan(kind)
    body = plan.parts[0]
    scale, margin = 400.0, 60
    low = min(point[0] for part in plan.parts for point in part.points) - 0.05
    mask = np.zeros((400, int((1.2 - low) * scale) + 2 * margin), np.uint8)

    def disc(forward: float, aside: float, radius: float) -> None:
        centre = (round(margin + scale * (forward - low)), round(200 + scale * aside))
        cv2.circle(mask, centre, max(2, round(scale * radius)), 1, -1)

    places = np.array([point[0] for point in body.points])
    for forward in np.linspace(places[0], places[-1], 200):
        disc(forward, 0.0, wide * float(np.interp(forward, places, body.deep)))
    for part in plan.parts[1:]:
        if part.name == "tail" and part.start is not None:
            chain = np.array([part.start, *part.points])
            for share in np.linspace(0.0, len(chain) - 1.0, 80):
                disc(float(np.interp(share, np.arange(len(chain)), chain[:, 0])), 0.0, 0.012)
    for forward in np.linspace(0.44, 0.5, 10):
        disc(forward, 0.16, 0.015)
        disc(forward, -0.16, 0.015)
    seen = mask[:, ::-1] if turned else mask
    found, is_sure = rounded(plan, SecondView((seen > 0,), "above.png"), SecondLooks())
    assert found.parts[0].round == pytest.approx(wide, rel=0.12)
    assert found.parts[1:] == plan.parts[1:]
    assert is_sure


def test_what_is_nowhere_as_thick_as_a_body_is_none() -> None:
    mask = np.zeros((60, 400), np.bool_)
    mask[30, 20:380] = True
    with pytest.raises(NotFoundError, match="what line shows"):
        rounded(load_plan("lizard"), SecondView((mask,), "line"), SecondLooks())


def test_pictures_that_are_none(tmp_path: Path) -> None:
    looks = SilhouettePictures()
    grey = np.random.default_rng(1).integers(0, 255, (60, 80, 3), dtype=np.uint8)
    cv2.imwrite(str(tmp_path / "photo.png"), grey)
    with pytest.raises(InputError, match="is no silhouette"):
        read_second_view(tmp_path / "photo.png", looks)
    for name, value in (("black.png", 0), ("white.png", 255)):
        cv2.imwrite(str(tmp_path / name), np.full((60, 80), value, np.uint8))
        with pytest.raises(InputError, match=name):
            read_second_view(tmp_path / name, looks)
    (tmp_path / "mixed").mkdir()
    cv2.imwrite(str(tmp_path / "mixed/a.png"), grey)
    side = side_view(100.0, flat=False).astype(np.uint8) * 255
    cv2.imwrite(str(tmp_path / "mixed/b.png"), side)
    with pytest.raises(InputError, match="1 silhouettes among 2"):
        read_second_view(tmp_path / "mixed", looks)
    (tmp_path / "none").mkdir()
    with pytest.raises(InputError, match="has no pictures"):
        read_second_view(tmp_path / "none", looks)
    cv2.imwrite(str(tmp_path / "good.png"), side)
    (mask,) = read_second_view(tmp_path / "good.png", looks).masks
    assert (mask == (side > 0)).mean() > 0.99
