"""The learned eyes on drawn facades, and on what is none."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from drawn_facade import draw_facade, rectified_of

from veduta.facade import analyse_seen
from veduta.facade.analyse import analyse
from veduta.facade.document import FacadeDocument, Source
from veduta.facade.evidence import Evidence
from veduta.facade.eyes import look
from veduta.facade.eyes.look import WEIGHTS
from veduta.facade.houses import PartyWall, PartyWalls
from veduta.facade.options import FacadeOptions
from veduta.facade.scale import ASSUMED_STOREY
from veduta.run.errors import NotFoundError

LARGEST_WEIGHTS = 5_000_000


def read(pixels: np.ndarray) -> FacadeDocument:
    height, width = pixels.shape[:2]
    source = Source(image="drawn.png", sha256="", width_px=width, height_px=height)
    return analyse(rectified_of(pixels), source, FacadeOptions())[0]


def test_a_drawn_facade_has_most_of_its_windows() -> None:
    drawn = draw_facade(5)
    document = read(drawn.pixels)
    found = [e for e in document.elements if e.class_ == "window"]
    near = sum(
        any(abs(e.x_px - x) < 8 and abs(e.y_px - y) < 8 for e in found)
        for x, y, _, _ in drawn.windows
    )
    assert near >= 0.7 * len(drawn.windows)
    assert read(drawn.pixels.copy()) == document, "the same picture gives the same document"


@pytest.mark.parametrize("kind", ["noise", "plain", "ramp"])
def test_what_is_no_facade_is_refused(kind: str) -> None:
    rng = np.random.default_rng(3)
    ramp = np.linspace(0, 255, 400, dtype=np.uint8)
    pictures = {
        "noise": rng.integers(0, 256, (400, 400, 3), dtype=np.uint8),
        "plain": np.full((400, 400, 3), 128, np.uint8),
        "ramp": np.repeat(np.tile(ramp, (400, 1))[..., None], 3, axis=2),
    }
    with pytest.raises(NotFoundError):
        read(pictures[kind])


def test_a_front_without_openings_between_its_sides_is_refused(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(analyse_seen, "in_crop", lambda *_: [])
    with pytest.raises(NotFoundError, match="is no window or door"):
        read(draw_facade(5).pixels)


def test_the_other_houses_have_the_scale_and_basis_of_the_widest(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    left, right = draw_facade(5).pixels, draw_facade(3).pixels
    high = min(len(left), len(right))
    pixels = np.hstack([left[-high:], right[-high:]])

    def one_wall(evidence: Evidence, *_: object) -> PartyWalls:
        at = round(evidence.width * left.shape[1] / pixels.shape[1])
        return PartyWalls((PartyWall(at, 0.99),))

    monkeypatch.setattr(analyse_seen, "find_party_walls", one_wall)
    source = Source(image="a.png", sha256="", width_px=pixels.shape[1], height_px=high)
    rectified = rectified_of(pixels)
    documents, steps, own = analyse_seen.analyse_houses(rectified, source, FacadeOptions())
    assert len(documents) == len(own) == 2
    first, second = (document.scale for document in documents)
    assert first.basis == second.basis == "assumed-storey"
    assert first.metres_per_px == pytest.approx(second.metres_per_px, rel=0.02)
    assert all(ASSUMED_STOREY in document.notes for document in documents)
    told = ["floors", "openings", "document"]
    assert sorted([step.name for step in each] for each in own) == [[], told]
    assert [step.name for step in steps] == ["eyes", "extent", "houses", *told]


def test_a_border_that_is_not_sure_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    pixels = draw_facade(5).pixels

    def unsure(evidence: Evidence, *_: object) -> PartyWalls:
        return PartyWalls((), PartyWall(evidence.width // 2, 0.6))

    monkeypatch.setattr(analyse_seen, "find_party_walls", unsure)
    source = Source(image="a.png", sha256="", width_px=pixels.shape[1], height_px=len(pixels))
    (document,), _, _ = analyse_seen.analyse_houses(rectified_of(pixels), source, FacadeOptions())
    assert any("may show several" in note and "50 %" in note for note in document.notes)


def test_a_look_is_a_distribution_over_the_whole_picture() -> None:
    seen = look(draw_facade(3).pixels)
    assert np.allclose(seen.classes.sum(0), 1.0, atol=1e-3)
    assert seen.chance("window", "wall").shape == seen.classes.shape[1:]
    assert seen.chance_at((50, 70), "sky").shape == (70, 50)
    assert (seen.borders > 0).all()


def test_the_weights_are_small() -> None:
    import veduta.facade.eyes as eyes

    assert Path(eyes.__file__).with_name(WEIGHTS).stat().st_size <= LARGEST_WEIGHTS
