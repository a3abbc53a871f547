"""GeoJSON in blocks: the same features as when it is read at once, whatever the blocks."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from veduta.grammar import json_stream
from veduta.grammar import lots as lots_module
from veduta.grammar.feature_stream import FeatureStream
from veduta.grammar.lots import read_lots
from veduta.run.errors import InputError

values: st.SearchStrategy[Any] = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats(-1e9, 1e9) | st.text(max_size=8),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=4), inner),
    max_leaves=6,
)
collections = st.fixed_dictionaries(
    {"type": st.just("FeatureCollection"), "features": st.lists(values, max_size=6)},
    optional={"crs": values, "näme": values, "bbox": st.integers()},
)


def streamed(folder: Path, text: str, block: int = 1 << 20) -> tuple[list[Any], dict[str, Any]]:
    path = folder / "lots.geojson"
    path.write_text(text, "utf-8")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(json_stream, "BLOCK_BYTES", block)
        stream = FeatureStream(path)
        return list(stream.features()), stream.members


@settings(
    max_examples=25, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(collections, st.sampled_from([1, 7, 40]), st.sampled_from([None, 2]), st.booleans())
def test_it_is_what_the_json_module_reads(
    tmp_path: Path, document: dict[str, Any], block: int, indent: int | None, plain: bool
) -> None:
    text = json.dumps(document, indent=indent, ensure_ascii=plain)
    features, members = streamed(tmp_path, text, block)
    truth = json.loads(text)
    assert features == truth.pop("features")
    assert members == truth


@pytest.mark.parametrize(
    "text",
    [
        "",
        "[]",
        '{"type": "FeatureCollection"}',
        '{"type": "Feature", "features": []}',
        '{"type": "FeatureCollection", "features": {}}',
        '{"type": "FeatureCollection", "features": [1, 2',
        '{"type": "FeatureCollection", "features": [1 2]}',
        '{"type": "FeatureCollection", "features": [1], }',
        '{"type": "FeatureCollection", "features": [1, ]}',
        '{"type": "FeatureCollection", "features": [' + "[" * 200_000,
    ],
)
def test_what_is_no_collection_is_refused(tmp_path: Path, text: str) -> None:
    with pytest.raises(InputError, match="is not GeoJSON"):
        streamed(tmp_path, text)


def test_a_value_without_end_is_stopped(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(json_stream, "MAX_VALUE", 10_000)
    with pytest.raises(InputError, match="a value of more than"):
        streamed(tmp_path, '{"features": ["' + "x" * 100_000, block=1000)


def test_lots_are_the_same_in_blocks(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    features = []
    for number in range(50):
        x = 84_000.0 + 15 * number
        ring = [[x, 4e5], [x + 12, 4e5], [x + 12, 4e5 + 9], [x, 4e5 + 9], [x, 4e5]]
        shape = {"type": "Polygon", "coordinates": [ring]}
        features.append({"type": "Feature", "id": number, "geometry": shape, "properties": None})
    crs = {"type": "name", "properties": {"name": "EPSG:28992"}}
    path = tmp_path / "lots.geojson"
    path.write_text(json.dumps({"type": "FeatureCollection", "features": features, "crs": crs}))
    whole = read_lots(path)
    monkeypatch.setattr(lots_module, "MAX_BYTES", 1000)
    parts = read_lots(path)
    assert (
        (parts.crs, parts.origin_m) == (whole.crs, whole.origin_m) == ("EPSG:28992", (84e3, 4e5, 0))
    )
    assert [lot.id for lot in parts.lots] == [lot.id for lot in whole.lots]
    assert [lot.anchor_m for lot in parts.lots] == [lot.anchor_m for lot in whole.lots]
