"""CityJSON in a stream and CityJSONSeq: the same lots as of the document that is read at once."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from test_city_lots import OUTLINE, City, prism

from veduta.grammar import city_stream, json_stream
from veduta.grammar import lots as lots_module
from veduta.grammar.lots import Lots, read_lots
from veduta.run.errors import InputError

HEAD = {
    "type": "CityJSON",
    "version": "2.0",
    "transform": {"scale": [0.01] * 3, "translate": [85_000.0, 446_000.0, 0.0]},
    "metadata": {"referenceSystem": "https://www.opengis.net/def/crs/EPSG/0/7415"},
}


def town() -> City:
    """Two houses, one that stands on nothing, and a road in the north."""
    city = City()
    city.building("a", prism(city, bottom=True))
    city.building("b", [[city.ring([[x + 30, y] for x, y in OUTLINE], 0)[::-1]]])
    city.building("bad", [[[0, 1, 5, 4]]])
    boundaries = [[city.ring([[4, 14], [8, 14], [6, 16]], 0)]]
    shape = {"type": "MultiSurface", "lod": "1", "boundaries": boundaries}
    city.objects["road"] = {"type": "Road", "geometry": [shape]}
    return city


def told(found: Lots) -> Any:
    """All that is known of lots, to be compared."""
    lots = [
        [lot.id, lot.name, lot.anchor_m, lot.attributes, [ring.tolist() for ring in lot.rings_m]]
        for lot in found.lots
    ]
    return lots, found.crs, found.origin_m, [failure.reason for failure in found.failures]


def sequence(city: City) -> list[str]:
    """The lines of a sequence; each feature has the vertices that it uses."""
    lines = [json.dumps(HEAD | {"CityObjects": {}, "vertices": []})]
    for name, one in city.objects.items():
        used: dict[int, int] = {}

        def own(value: Any, used: dict[int, int] = used) -> Any:
            if isinstance(value, list):
                return [own(inner) for inner in value]
            return used.setdefault(value, len(used))

        shape = one["geometry"][0]
        moved = one | {"geometry": [shape | {"boundaries": own(shape["boundaries"])}]}
        vertices = [city.vertices[number] for number in used]
        feature = {"type": "CityJSONFeature", "id": name, "CityObjects": {name: moved}}
        lines.append(json.dumps(feature | {"vertices": vertices}))
    return lines


@pytest.mark.parametrize("first", ["vertices", "CityObjects", "transform"])
def test_a_document_in_a_stream(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, first: str
) -> None:
    city = town()
    whole = city.read(tmp_path)
    assert [lot.name for lot in whole.lots] == ["a", "b"]
    document = HEAD | {"CityObjects": city.objects, "vertices": city.vertices}
    path = tmp_path / "city.json"
    path.write_text(json.dumps({first: document.pop(first)} | document, indent=1))
    monkeypatch.setattr(lots_module, "MAX_BYTES", 100)
    monkeypatch.setattr(json_stream, "BLOCK_BYTES", 40)
    monkeypatch.setattr(city_stream, "AT_ONCE", 3)
    assert told(read_lots(path)) == told(whole)


def test_a_sequence(tmp_path: Path) -> None:
    whole = town().read(tmp_path)
    path = tmp_path / "town.city.jsonl"
    path.write_text("\n".join(sequence(town())) + "\n")
    assert told(read_lots(path)) == told(whole)


def test_bad_lines_of_a_sequence_are_failures(tmp_path: Path) -> None:
    header, good, *_ = sequence(town())
    bad = ["{", '{"type": "Feature"}', good.replace("[1200, 0, 100]", '["x", 0, 0]'), "[NaN]"]
    path = tmp_path / "town.city.jsonl"
    path.write_text("\n".join([header, *bad, "", good]))
    found = read_lots(path)
    assert [lot.name for lot in found.lots] == ["a"]
    lines = [failure.subject.rpartition(" ")[2] for failure in found.failures]
    assert lines == ["2", "3", "4", "5"]


@pytest.mark.parametrize(
    ("change", "fault"),
    [
        (lambda lines: "\n".join(lines)[:-30], "ends within line 5"),
        (lambda lines: "\n".join(lines[1:]), "first line is no CityJSON"),
        (lambda lines: "", "no lot that can be used|no CityJSON"),
    ],
)
def test_a_sequence_that_is_none(tmp_path: Path, change: Any, fault: str) -> None:
    path = tmp_path / "town.city.jsonl"
    path.write_text(change(sequence(town())))
    with pytest.raises(InputError, match=fault):
        read_lots(path)


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ('{"type": "CityJSON", "CityObjects": {}, "vertices": [[0, 0, 0], [1', "no end"),
        ('{"type": "CityJSON", "CityObjects": {}, "vertices": [[0, 0], [1, 2]]}', "no vertices"),
        ('{"type": "CityJSON", "CityObjects": {}, "vertices": [[0, 0, 1e999]]}', "not finite"),
        ('{"type": "CityJSON", "vertices": [[0, 0, 0]]}', "no CityObjects"),
        ('{"type": "CityJSON", "CityObjects": {}}', "no vertices"),
        ('{"vertices": [[0, 0, 0], "a"], "CityObjects": {}}', "no vertices|from here on"),
    ],
)
def test_a_document_that_cannot_be_used(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, text: str, fault: str
) -> None:
    monkeypatch.setattr(lots_module, "MAX_BYTES", 10)
    path = tmp_path / "city.json"
    path.write_text(text)
    with pytest.raises(InputError, match=fault):
        read_lots(path)


def test_a_broken_object_of_a_document_is_a_failure(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    city = town()
    document = HEAD | {"CityObjects": city.objects, "vertices": city.vertices}
    path = tmp_path / "city.json"
    text = json.dumps(document)
    path.write_text(text.replace('"bad": {', '"bad": {"x": 01, ', 1))
    monkeypatch.setattr(lots_module, "MAX_BYTES", 10)
    found = read_lots(path)
    assert [lot.name for lot in found.lots] == ["a", "b"]
    (failure,) = found.failures
    assert (failure.subject, "no JSON" in failure.reason) == (f"{path}: bad", True)


def test_vertices_stay_exact(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The shoelace area of the file's own numbers is the oracle."""
    city = town()
    path = tmp_path / "city.json"
    path.write_text(json.dumps(HEAD | {"CityObjects": city.objects, "vertices": city.vertices}))
    monkeypatch.setattr(lots_module, "MAX_BYTES", 10)
    x, y = np.array(OUTLINE, dtype=float).T
    expected = 0.5 * float(x @ np.roll(y, -1) - y @ np.roll(x, -1))
    for lot in read_lots(path).lots:
        x, y = lot.rings_m[0].T
        assert 0.5 * float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) == pytest.approx(expected)
