"""The rules of a photographed building, derived again by `veduta grammar`."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import numpy as np
import pytest
from closed_shells import assert_closed
from command_line import read_json, veduta
from PIL import Image, ImageOps
from test_validators import validate_gltf

from veduta.formats.gltf import read_glb


@pytest.fixture
def house(tmp_path: Path, one_house: Path) -> Path:
    """The results of the photo, moved away from where they were made."""
    return Path(shutil.copytree(one_house / "house0", tmp_path / "moved"))


def derive(house: Path, out: Path, *more: object) -> Path:
    """Derive the rules on their lot; the model."""
    rules, lot = house / "cells.cga", house / "lot.geojson"
    done = veduta("grammar", "derive", rules, "--lots", lot, "-o", out, *more)
    assert (done.returncode, done.stderr.count("error")) == (0, 0), done.stderr
    return out / "parts" / "00" / "house0.glb"


def test_the_rules_are_clean_and_laid_out(house: Path) -> None:
    rules = house / "cells.cga"
    done = veduta("grammar", "check", rules)
    assert done.stdout == f"{rules}: 0 errors, 0 warnings\n"
    assert veduta("grammar", "format", rules).stdout == rules.read_text()


def test_the_rules_alone_make_the_same_building(house: Path, tmp_path: Path) -> None:
    found = derive(house, tmp_path / "again")
    model, again = read_glb(house / "model.glb"), read_glb(found)
    assert again.features.id == model.features.id
    for column in ("class_code", "provenance_code", "parent", "shell"):
        np.testing.assert_array_equal(
            getattr(again.features, column), getattr(model.features, column)
        )
    assert again.positions_m.tobytes() == model.positions_m.tobytes()
    np.testing.assert_allclose(np.clip(again.uv, 0, 1), model.uv, atol=1e-6)
    textures = [part.materials for part in (again, model)]
    for own, there in zip(*textures, strict=True):
        assert (own.name, own.colour) == (there.name, there.colour)
        assert (own.texture is None) == (there.texture is None)
        if own.texture is not None and there.texture is not None:
            assert np.array_equal(own.texture.invented, there.texture.invented)
            difference = own.texture.pixels.astype(int) - there.texture.pixels
            assert np.abs(difference).mean() < 2.0  # JPEG, once more
    issues = validate_gltf(found)
    assert (issues["numErrors"], issues["numWarnings"]) == (0, 0), issues["messages"]


def test_an_edited_size_makes_another_building(house: Path, tmp_path: Path) -> None:
    rules = house / "cells.cga"
    text = rules.read_text()
    lines = [line for line in text.splitlines() if line.startswith("attr floor1 = ")]
    (line,) = lines
    height_m = float(line.rpartition(" ")[2])
    rules.write_text(text.replace(line, f"attr floor1 = {height_m + 0.5:.3f}"))
    before = read_glb(house / "model.glb")
    after = read_glb(derive(house, tmp_path / "again"))
    assert after.bounds_m[1][2] == pytest.approx(before.bounds_m[1][2] + 0.5, abs=1e-3)
    assert after.features.id == before.features.id
    assert_closed(after)


def test_another_picture_is_another_building(house: Path, tmp_path: Path) -> None:
    out = tmp_path / "again"
    before = derive(house, out).read_bytes()
    for picture in (house / "textures").glob("*.jpg"):
        with Image.open(picture) as seen:
            ImageOps.mirror(seen).save(picture)
    rules, lot = house / "cells.cga", house / "lot.geojson"
    refused = veduta("grammar", "derive", rules, "--lots", lot, "-o", out)
    assert refused.returncode == 2
    assert derive(house, out, "--force").read_bytes() != before


def test_edited_rules_are_kept_and_told(one_house: Path, tmp_path: Path) -> None:
    """The document is what the verb rebuilds from; rules that somebody edited are theirs."""
    out = Path(shutil.copytree(one_house, tmp_path / "out"))
    rules, document = out / "house0" / "cells.cga", out / "house0" / "facade.json"
    rules.write_text(rules.read_text() + "// mine\n")
    content = read_json(document)
    content["model"]["setback_m"] = 0.35
    document.write_text(json.dumps(content))
    done = veduta("facade", document, "-o", out)
    assert done.returncode == 0, done.stderr
    assert f"{rules}: was edited and is left as it is" in done.stdout
    assert rules.read_text().endswith("// mine\n")
