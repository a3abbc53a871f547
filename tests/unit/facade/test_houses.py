"""Party walls between drawn houses, and how several houses of a photo are told and placed."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from pydantic import JsonValue
from sample_document import sample_document

from veduta.facade.arrangement import GAP_M, Placed, arrange
from veduta.facade.document import FacadeDocument
from veduta.facade.evidence import gather
from veduta.facade.eyes import SeenElement
from veduta.facade.house_folders import (
    HOUSES_DOUBTED,
    Beside,
    beside_found,
    beside_kept,
    beside_line,
    beside_of,
    beside_told,
    houses_doubt,
)
from veduta.facade.houses import (
    HouseParameters,
    PartyWall,
    chance_of,
    house_spans,
    party_walls_of,
    storey_of,
)
from veduta.facade.model import build_model
from veduta.facade.party_signs import SIGNS, Fronts, signs_at
from veduta.facade.report import summary_line

HEIGHT, WIDE = 400, 240
COLOURS = [(205, 180, 140), (150, 190, 160), (180, 120, 90)]


class Row:
    """Houses beside each other: wall colours, windows, a roof line each."""

    def __init__(self, colours: list[int], shifts: list[int], roofs: list[int]) -> None:
        size = HEIGHT, WIDE * len(colours)
        picture = np.full((*size, 3), 235, np.uint8)
        kinds = np.zeros((6, *size), np.float32)
        kinds[4] = 1.0
        windows: list[SeenElement] = []
        for k, (colour, shift, roof) in enumerate(zip(colours, shifts, roofs, strict=True)):
            span = slice(k * WIDE, (k + 1) * WIDE)
            picture[roof:, span] = COLOURS[colour]
            kinds[4, roof:, span] = 0.0
            kinds[5, roof : roof + 14, span] = 1.0
            picture[roof : roof + 14, span] //= 2
            for floor in range(4):
                for column in range(3):
                    x, y = k * WIDE + 30 + 70 * column, 60 + 80 * floor + shift
                    picture[y : y + 44, x : x + 30] = 40
                    kinds[:, y : y + 44, x : x + 30] = 0.0
                    kinds[0, y : y + 44, x : x + 30] = 1.0
                    windows.append(SeenElement("window", x, y, x + 30, y + 44, 0.9))
        noise = np.random.default_rng(1).normal(0, 6, picture.shape)
        pixels = np.clip(picture + noise, 0, 255).astype(np.uint8)
        evidence = gather(pixels, np.ones(size, np.bool_))
        assert evidence.px_per_rectified == 1.0
        wall = 1.0 - kinds.sum(axis=0)
        top = (kinds[4] < 0.5).argmax(axis=0).astype(np.float64)
        self.fronts = Fronts(evidence, wall, kinds, top, tuple(windows), storey_of(windows))

    def found(self) -> list[int]:
        """Where walls are found."""
        return [wall.x for wall in party_walls_of(self.fronts).walls]

    def signs(self, x: int) -> dict[str, float]:
        """The signs at a column, by name."""
        signs = signs_at(self.fronts, x)
        assert signs is not None
        return dict(zip(SIGNS, signs.tolist(), strict=True))


@pytest.mark.parametrize(
    ("colours", "shifts", "roofs"),
    [
        ([0, 1], [0, 30], [10, 40]),
        ([0, 1], [0, 30], [10, 10]),
        ([0, 1, 2], [0, 30, 5], [20, 20, 40]),
    ],
)
def test_houses_that_differ_are_parted(
    colours: list[int], shifts: list[int], roofs: list[int]
) -> None:
    found = Row(colours, shifts, roofs).found()
    assert found == pytest.approx([WIDE * k for k in range(1, len(colours))], abs=25)


@pytest.mark.parametrize(
    ("colours", "shifts", "roofs"),
    [
        ([0, 0], [0, 0], [20, 20]),
        ([0, 0, 0], [0, 0, 0], [20, 20, 20]),
        ([0, 0], [0, 0], [10, 40]),  # a lower wing
    ],
)
def test_one_house_is_one(colours: list[int], shifts: list[int], roofs: list[int]) -> None:
    assert Row(colours, shifts, roofs).found() == []


def test_each_sign_tells_what_it_is_named_after() -> None:
    plain = Row([0, 0], [0, 0], [20, 20]).signs(WIDE)
    assert max(plain[name] for name in ("rows", "sizes", "colour", "roof")) < 0.1
    assert Row([0, 0], [0, 16], [20, 20]).signs(WIDE)["rows"] == pytest.approx(1.0, abs=0.05)
    assert Row([0, 1], [0, 0], [20, 20]).signs(WIDE)["colour"] > 1.0
    assert Row([0, 0], [0, 0], [10, 50]).signs(WIDE)["roof"] == pytest.approx(1.0, abs=0.05)
    shifted = Row([0, 0], [0, 30], [20, 20]).signs(WIDE)
    assert shifted["lines"] > plain["lines"] + 0.5
    assert shifted["classes"] > plain["classes"] + 0.1


def test_the_edge_of_a_picture_is_no_border() -> None:
    assert signs_at(Row([0], [0], [20]).fronts, 2) is None


def test_the_chance_is_that_of_the_weighted_signs() -> None:
    own = HouseParameters(weights=(1.0,) + (0.0,) * 8, offset=-1.0, most=2.0)
    assert chance_of(np.array([1.0, *[0.0] * 8]), own) == pytest.approx(0.5)
    assert chance_of(np.array([9.0, *[0.0] * 8]), own) == pytest.approx(1 / (1 + np.exp(-1.0)))


def test_few_windows_are_no_houses() -> None:
    fronts = Row([0, 1], [0, 30], [10, 40]).fronts
    walls = [PartyWall(WIDE, 0.99)]
    size = (0, 2 * WIDE)
    whole = house_spans(walls, fronts.windows, size, fronts.storey)
    assert whole == [(0, WIDE), (WIDE, 2 * WIDE)]
    assert house_spans(walls, fronts.windows[:15], size, fronts.storey) == [(0, WIDE)]
    assert house_spans(walls, fronts.windows[:3], size, fronts.storey) == [size]


def test_houses_of_one_photo_stand_wall_to_wall() -> None:
    right = Beside("house-2", (0.0, -0.6, 0.0), (6.0, 10.0, 9.0), 8.0)
    left = Beside("house-1", (0.0, -0.6, 0.0), (5.0, 10.0, 9.0), -5.0)
    main = Placed("a", (0.0, -0.6, 0.0), (8.0, 10.0, 12.0), beside=(left, right))
    other = Placed("b", (-0.1, -0.6, 0.0), (7.0, 10.0, 12.0))
    place = arrange([main, other], Path())
    rows = {p.row.id: p.row for p in place.parts.values() if p.row is not None}
    assert list(rows) == ["a", "a-house-1", "a-house-2", "b"]
    assert rows["a-house-2"].model == "a/house-2/model.glb"
    shifts = {name: row.transform[12] for name, row in rows.items()}
    assert shifts["a-house-2"] - shifts["a"] == 8.0
    assert shifts["a-house-1"] - shifts["a"] == -5.0
    assert shifts["b"] - 0.1 == pytest.approx(shifts["a"] + 14.0 + GAP_M)


def test_what_a_summary_says_of_the_others_comes_back() -> None:
    told = {
        "beside": [
            {
                "folder": "house-2",
                "storeys": 4,
                "offset_m": 8.0,
                "bounds_min": [0.0, 0.0, 0.0],
                "bounds_max": [6.0, 10.0, 9.0],
            }
        ]
    }
    assert beside_of(told) == (Beside("house-2", (0.0, 0.0, 0.0), (6.0, 10.0, 9.0), 8.0),)
    assert beside_line(told) == "1 more house of the photo: house-2"
    assert (beside_of({}), beside_line({})) == ((), "")
    assert beside_found(told) == [], "a run before these numbers were kept"


def test_each_further_house_has_a_line_of_numbers() -> None:
    main, other = _house(0, 100, 0.05), _house(100, 80, 0.05)
    part = build_model(sample_document(), np.full((800, 520, 3), 150, np.uint8), "b").part
    numbers = {"windows": 7, "width_m": 4.0, "height_m": 9.5, "scale": "assumed"}
    told = beside_told(main, [("house-2", other, part)], [numbers])
    ((folder, found),) = beside_found(told)
    assert folder == "house-2"
    assert summary_line(found) == "5 storeys, 7 windows, 4.0 x 9.5 m (scale assumed)"


def test_a_photo_that_is_called_as_a_house_keeps_its_id() -> None:
    box = (0.0, -0.6, 0.0), (8.0, 10.0, 12.0)
    main = Placed("a", *box, beside=(Beside("house-2", *box, 8.0),))
    place = arrange([main, Placed("a-house-2", *box), Placed("a-house-2-2", *box)], Path())
    models = {p.row.id: p.row.model for p in place.parts.values() if p.row is not None}
    assert models == {
        "a": "a/model.glb",
        "a-house-2-3": "a/house-2/model.glb",
        "a-house-2": "a-house-2/model.glb",
        "a-house-2-2": "a-house-2-2/model.glb",
    }


def _house(x_px: float, width_px: float, metres_per_px: float) -> FacadeDocument:
    document = sample_document()
    facade = document.facade.model_copy(
        update={"x_px": x_px, "width_px": width_px, "width_m": width_px * metres_per_px}
    )
    scale = document.scale.model_copy(update={"metres_per_px": metres_per_px})
    return document.model_copy(update={"facade": facade, "scale": scale})


def test_houses_stay_wall_to_wall_where_the_main_one_was_edited(tmp_path: Path) -> None:
    others = {"house-1": _house(0, 100, 0.05), "house-3": _house(300, 80, 0.05)}
    rows: list[JsonValue] = []
    for name, document in others.items():
        (tmp_path / name).mkdir()
        text = document.model_dump_json(by_alias=True)
        (tmp_path / name / "facade.json").write_text(text, encoding="utf-8")
        rows.append({"folder": name, "offset_m": -99.0})
    rows.append({"folder": "house-9", "offset_m": 7.0})
    main = _house(110, 190, 0.1)  # the scale was 0.05, and the left border at 100
    kept = beside_kept({"beside": rows}, main, tmp_path)["beside"]
    assert isinstance(kept, list)
    offsets = [row["offset_m"] for row in kept if isinstance(row, dict)]
    assert offsets == pytest.approx([-5.0 - 0.5, 19.0, 7.0]), "the last one's document is gone"
    assert beside_kept({}, main, tmp_path) == {}


def test_a_doubt_of_houses_is_told_at_the_terminal() -> None:
    document = sample_document()
    assert houses_doubt(document) == {}
    note = f"{HOUSES_DOUBTED}; what is left and right of 49 % of its width differs"
    doubted = document.model_copy(update={"notes": ["other", note]})
    assert houses_doubt(doubted) == {"houses": note}
