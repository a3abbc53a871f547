"""Recesses and projections from a depth map whose truth is known; depth maps that do not fit."""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from drawn_facade import DrawnFacade, analysed, draw_facade
from numpy.typing import NDArray
from PIL import Image

from veduta.facade.batch import run_call
from veduta.facade.document import Element, FacadeDocument
from veduta.facade.load import DOCUMENT, load_document
from veduta.facade.measured import of_photo, with_depths
from veduta.facade.model import build_model
from veduta.facade.options import (
    DepthOptions,
    EyesOptions,
    FacadeOptions,
    RectifyOptions,
    ScaleOptions,
)
from veduta.place.semantics import Provenance
from veduta.run.errors import InputError
from veduta.run.progress import Progress

QUIET = Progress(quiet=True)
PX_M = 0.025
DEEP_M, OUT_M, LEDGE_M = 0.23, 0.85, 0.31
PLANE = (0.14, 0.2, -0.1)
"""Where the wall's true surface lies before its plane: at its middle, along it and down it (m)."""


@dataclass(frozen=True)
class _Truth:
    """A drawn front and its depth map, with what stands where."""

    drawn: DrawnFacade
    depths_m: NDArray[np.float32]
    deep_m: list[float]


def _truth(seed: int = 0, noise_m: float = 0.01) -> _Truth:
    """Each window lies back by another length; noise, holes, and outliers as of mirrors."""
    drawn = draw_facade()
    rng = np.random.default_rng(seed)
    height, width = drawn.pixels.shape[:2]
    x, y = np.arange(width) / width - 0.5, np.arange(height)[:, None] / height - 0.5
    depths = PLANE[0] + PLANE[1] * x + PLANE[2] * y
    deep = []
    for number, (left, top, wide, high) in enumerate(drawn.windows):
        deep.append(DEEP_M + 0.05 * (number % 3 - 1))
        depths[top : top + high, left : left + wide] -= deep[-1]
    top = drawn.boundaries[1]
    depths[top - 12 : top] += LEDGE_M
    depths += rng.normal(0.0, noise_m, depths.shape)
    wrong = rng.random(depths.shape) < 0.05
    depths[wrong] += rng.uniform(-3.0, 3.0, int(wrong.sum()))
    depths[rng.random(depths.shape) < 0.3] = np.nan
    return _Truth(drawn, depths.astype(np.float32), deep)


@cache
def _document() -> FacadeDocument:
    """What the drawn front is read as; all depth maps here are of this front."""
    return analysed(draw_facade().pixels, ScaleOptions(height_m=17.0))


def _written(folder: Path, truth: _Truth, wall: str = "w007", **told: object) -> tuple[Path, Path]:
    """The photo and the depth map as `veduta photos` and `veduta dense` name them."""
    photo, path = folder / "w007.png", folder / "w007_depth.tif"
    Image.fromarray(truth.drawn.pixels).save(photo)
    Image.fromarray(truth.depths_m, mode="F").save(path, compression="tiff_lzw")
    sidecar = {"schema": "veduta/elevation", "version": 1, "unit": "metres", "wall": wall}
    sidecar |= {"units_per_px": PX_M, "left": 0.0, "upper": 20.0, "cell_px": 1, **told}
    path.with_suffix(".json").write_text(json.dumps(sidecar), encoding="utf-8")
    return photo, path


def _with_balcony(document: FacadeDocument) -> FacadeDocument:
    """A balcony before the first two windows of the second row from below."""
    row = sorted((e for e in document.elements if e.class_ == "window"), key=lambda e: -e.y_px)
    below = sorted((e for e in row if abs(e.y_px - row[0].y_px) < 5), key=lambda e: e.x_px)[:2]
    scale, box = document.scale.metres_per_px, document.facade
    x, right = below[0].x_px - 10, below[1].x_px + below[1].width_px + 10
    y, high = below[0].y_px + 0.6 * below[0].height_px, 0.5 * below[0].height_px
    balcony = Element.model_validate(
        {
            "class": "balcony",
            "x_px": x,
            "y_px": y,
            "width_px": right - x,
            "height_px": high,
            "x_m": (x - box.x_px) * scale,
            "y_m": (box.y_px + box.height_px - y - high) * scale,
            "width_m": (right - x) * scale,
            "height_m": high * scale,
            "score": 0.9,
        }
    )
    return document.model_copy(update={"elements": [*document.elements, balcony]})


def test_what_was_measured_is_the_truth(tmp_path: Path) -> None:
    truth = _truth()
    document = _with_balcony(_document())
    balcony = document.elements[-1]
    rows = slice(round(balcony.y_px), round(balcony.y_px + balcony.height_px))
    columns = slice(round(balcony.x_px), round(balcony.x_px + balcony.width_px))
    height, width = truth.depths_m.shape
    x, y = np.arange(width) / width - 0.5, np.arange(height)[:, None] / height - 0.5
    plane = PLANE[0] + PLANE[1] * x + PLANE[2] * y
    bars = np.zeros((height, width), dtype=np.bool_)
    bars[rows, columns] = (np.arange(width) % 5 < 2)[columns]  # one sees between the railing's bars
    truth.depths_m[bars] = (plane + OUT_M)[bars]
    photo, path = _written(tmp_path, truth)
    found = with_depths(document, path, of_photo(path, photo))
    assert found.depths is not None
    windows = [e for e in found.elements if e.class_ == "window" and e.depth_m is not None]
    for window in windows:
        centre = window.x_px + window.width_px / 2, window.y_px + window.height_px / 2
        inside = [
            deep
            for (left, top, wide, high), deep in zip(truth.drawn.windows, truth.deep_m, strict=True)
            if left < centre[0] < left + wide and top < centre[1] < top + high
        ]
        assert window.depth_m == pytest.approx(-inside[0], abs=0.012)
    assert len(windows) >= len(truth.drawn.windows) - 2
    classes = {one.kind: one for one in found.depths.classes}
    assert classes["window"].median_m == pytest.approx(-DEEP_M, abs=0.012)
    assert 0.02 < classes["window"].spread_m < 0.09
    assert found.elements[-1].depth_m == pytest.approx(OUT_M, abs=0.03)
    assert len(found.depths.ledges) == 1
    ledge = found.depths.ledges[0]
    assert ledge.out_m == pytest.approx(LEDGE_M, abs=0.01)
    assert ledge.y_px == pytest.approx(truth.drawn.boundaries[1] - 12, abs=1.0)
    assert ledge.height_px == pytest.approx(12, abs=1.5)
    assert found.depths.known == pytest.approx(0.7, abs=0.02)
    assert found.depths.wall_spread_m == pytest.approx(0.01, abs=0.006)


def test_the_model_has_the_depths_and_says_that_they_are_measured(tmp_path: Path) -> None:
    truth = _truth()
    document = _with_balcony(_document())
    photo, path = _written(tmp_path, truth)
    found = with_depths(document, path, of_photo(path, photo))
    elements = list(found.elements)
    elements[-1] = elements[-1].model_copy(update={"depth_m": OUT_M})
    found = found.model_copy(update={"elements": elements})
    part = build_model(found, truth.drawn.pixels, "house").part
    names = list(part.features.name)
    said = part.features.provenance
    balcony = names.index("floor and sides of balcony 1")
    assert said(balcony) is Provenance.MEASURED
    assert said(names.index("cornice 1")) is Provenance.MEASURED
    low = part.bounds_m[0]
    assert low[1] == pytest.approx(-OUT_M, abs=2e-3)  # the facade's plane is y = 0
    measured = sum(e.depth_m is not None for e in found.elements if e.class_ == "window")
    reveals = [row for row, name in enumerate(names) if name.startswith("reveal of window")]
    assert sum(said(row) is Provenance.MEASURED for row in reveals) >= measured - 2
    plain = build_model(document, truth.drawn.pixels, "house").part
    reveals = [k for k, name in enumerate(plain.features.name) if name.startswith("reveal of")]
    assert {plain.features.provenance(row) for row in reveals} == {Provenance.INFERRED}


def test_a_call_takes_depths_and_scale_and_a_rebuild_keeps_them(tmp_path: Path) -> None:
    truth = _truth()
    photo, path = _written(tmp_path, truth)
    options = FacadeOptions(
        eyes=EyesOptions(eyes="plain"),
        rectify=RectifyOptions(rectified=True, max_side_px=500),
        depth=DepthOptions(depth_map=path),
    )
    out = tmp_path / "out"
    assert run_call([photo], out, options, QUIET, jobs=1).exit_code == 0
    document = load_document(out / "w007" / DOCUMENT)
    assert document.scale.basis == "depth-map"
    shrink = max(truth.drawn.pixels.shape) / 500
    assert document.scale.metres_per_px == pytest.approx(PX_M * shrink, rel=0.01)
    assert document.depths is not None
    window = next(one for one in document.depths.classes if one.kind == "window")
    assert window.median_m == pytest.approx(-DEEP_M, abs=0.02)
    notes = " ".join(document.notes)
    assert "depth map: window" in notes
    assert "ledge juts out by 0.31 m" in notes
    again = tmp_path / "again"
    assert run_call([out / "w007" / DOCUMENT], again, FacadeOptions(), QUIET, jobs=1).exit_code == 0
    model = "w007/model.glb"
    assert (again / model).read_bytes() == (out / model).read_bytes()
    # Another depth map is another call.
    truth.depths_m[:40] = np.nan
    _written(tmp_path, truth)
    with pytest.raises(InputError, match="other"):
        run_call([photo], out, options, QUIET, jobs=1)


def test_what_the_depth_map_does_not_resolve_is_not_measured(tmp_path: Path) -> None:
    truth = _truth()
    photo, path = _written(tmp_path, truth, detail=1.5)
    found = with_depths(_document(), path, of_photo(path, photo))
    assert found.depths is not None
    assert all(one.depth_m is None for one in found.elements if one.class_ == "window")
    assert found.depths.ledges == ()
    assert any("window: none of" in note for note in found.notes)
    part = build_model(found, truth.drawn.pixels, "house").part
    reveals = [k for k, name in enumerate(part.features.name) if name.startswith("reveal of")]
    assert {part.features.provenance(row) for row in reveals} == {Provenance.INFERRED}


def test_an_empty_depth_map_measures_nothing_and_says_so(tmp_path: Path) -> None:
    truth = _truth()
    truth.depths_m[:] = np.nan
    photo, path = _written(tmp_path, truth)
    document = _document()
    found = with_depths(document, path, of_photo(path, photo))
    assert found.elements == document.elements
    assert any("nothing" in note or "too little" in note for note in found.notes)


@pytest.mark.parametrize(
    ("case", "fault", "remedy"),
    [
        ("wall", r"is of wall w003, and the photo is w007\.png", r"w003\.png"),
        ("unit", "not known in metres", "--metres-per-unit"),
        ("size", r"400 x 300 px, and the photo", "make the depth map again"),
        ("no sidecar", r"w007_depth\.json: does not exist, so nothing says where", "veduta dense"),
        ("bad sidecar", r"w007_depth\.json: does not describe an elevation", "veduta dense"),
        ("no map", r"w007_depth\.tif: does not exist", "veduta dense"),
        ("no picture", "cannot be|not an image|no image|damaged", ""),
    ],
)
def test_a_depth_map_that_does_not_fit_is_refused(
    tmp_path: Path, case: str, fault: str, remedy: str
) -> None:
    truth = _truth()
    told: dict[str, object] = {"unit": "unknown"} if case == "unit" else {}
    photo, path = _written(tmp_path, truth, wall="w003" if case == "wall" else "w007", **told)
    if case == "size":
        Image.fromarray(np.zeros((300, 400), dtype=np.float32), mode="F").save(path)
    elif case == "no sidecar":
        path.with_suffix(".json").unlink()
    elif case == "bad sidecar":
        path.with_suffix(".json").write_text("{}", encoding="utf-8")
    elif case == "no map":
        path.unlink()
    elif case == "no picture":
        path.write_bytes(b"nothing")
    with pytest.raises(InputError, match=f"(?s)({fault}).*{remedy}"):
        of_photo(path, photo)


def test_a_map_of_bytes_has_no_depths(tmp_path: Path) -> None:
    truth = _truth()
    photo, path = _written(tmp_path, truth)
    Image.fromarray(truth.drawn.pixels).save(path)
    with pytest.raises(InputError, match="has no depths"):
        with_depths(_document(), path, of_photo(path, photo))


def test_one_wall_for_one_photo(tmp_path: Path) -> None:
    photo, path = _written(tmp_path, _truth())
    other = tmp_path / "other.png"
    other.write_bytes(photo.read_bytes())
    options = FacadeOptions(depth=DepthOptions(depth_map=path))
    with pytest.raises(InputError, match="2 photos"):
        run_call([photo, other], tmp_path / "out", options, QUIET, jobs=1)
