"""The page on which one clicks where a drive begins."""

from __future__ import annotations

import base64
import json
import re
from io import BytesIO
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from veduta.cli.main import main
from veduta.drive.start_page import LONGEST_PX, write_start_page
from veduta.run.errors import InputError
from veduta.synthetic.drives.surface import write_surface

CELL_M, LOW = 2.0, (1000.0, 5000.0)


def log_with(folder: Path, heights: np.ndarray, more: str = "") -> Path:
    write_surface(heights.astype(np.float32), LOW, folder / "model <1>.tif", CELL_M)
    text = f'[surface]\nfile = "model <1>.tif"\n{more}'
    (folder / "drive.toml").write_text(text, encoding="utf-8")
    return folder


def parts_of(page: Path) -> tuple[dict, np.ndarray]:
    text = page.read_text("utf-8")
    found = re.search(r'<script id="page" type="application/json">(.*?)</script>', text, re.S)
    assert found is not None
    picture = re.search(r'src="data:image/jpeg;base64,([^"]+)"', text)
    assert picture is not None
    pixels = np.asarray(Image.open(BytesIO(base64.b64decode(picture[1]))))
    return json.loads(found[1]), pixels


def test_the_page_knows_where_its_picture_lies(tmp_path: Path) -> None:
    heights = np.zeros((40, 60))
    heights[30:36, 50:56] = 12.0  # a house in the north-east
    page = tmp_path / "start.html"
    write_start_page(log_with(tmp_path, heights), page)
    place, pixels = parts_of(page)
    corners = {"low": [1000.0, 5000.0], "high": [1120.0, 5080.0]}
    assert place == {"file": "model <1>.tif", **corners, "kept": []}
    assert pixels.shape == (40, 60, 3)
    light = pixels.mean(axis=2)
    row, column = np.unravel_index(light.argmax(), light.shape)
    # North is up.
    assert 4 <= row < 10
    assert 50 <= column < 56
    assert 'id="x" type="number" step="any" value=""' in page.read_text("utf-8")


def test_what_is_known_of_the_start_stands_there(tmp_path: Path) -> None:
    more = "start = [1010.5, 5020.0]\nheading_deg = -45.0\nwithin_m = 8.0\n"
    page = tmp_path / "start.html"
    write_start_page(log_with(tmp_path, np.zeros((20, 20)), more), page)
    for key, value in (("x", 1010.5), ("y", 5020.0), ("heading", -45.0), ("within", 8.0)):
        assert f'id="{key}" type="number" step="any" value="{value}"' in page.read_text("utf-8")


def test_other_settings_of_the_surface_are_kept(tmp_path: Path) -> None:
    more = "start = [1010.5, 5020.0]\nwithin_deg = 12.0\nsure = true\n"
    page = tmp_path / "start.html"
    write_start_page(log_with(tmp_path, np.zeros((20, 20)), more), page)
    place, _ = parts_of(page)
    assert set(place["kept"]) == {"within_deg = 12.0", "sure = true"}


def test_a_folder_that_is_not_there_is_named(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="there is no such folder") as raised:
        write_start_page(log_with(tmp_path, np.zeros((20, 20))), tmp_path / "nothere" / "a.html")
    assert "Make it first" in raised.value.remedy


def test_a_large_model_is_shown_smaller(tmp_path: Path) -> None:
    page = tmp_path / "start.html"
    write_start_page(log_with(tmp_path, np.zeros((100, 2 * LONGEST_PX))), page)
    place, pixels = parts_of(page)
    assert pixels.shape[1] == LONGEST_PX
    assert place["high"][0] == LOW[0] + 2 * LONGEST_PX * CELL_M
    assert "A pixel of the picture is 4 m." in page.read_text("utf-8")


def test_a_log_without_a_model_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no such file"):
        write_start_page(tmp_path, tmp_path / "start.html")
    (tmp_path / "drive.toml").write_text('name = "x"\n', encoding="utf-8")
    with pytest.raises(InputError, match="names no surface model"):
        write_start_page(tmp_path, tmp_path / "start.html")
    (tmp_path / "drive.toml").write_text('[surface]\nfile = "gone.tif"\n', encoding="utf-8")
    with pytest.raises(InputError, match="no such file"):
        write_start_page(tmp_path, tmp_path / "start.html")
    assert not (tmp_path / "start.html").exists()


def test_the_command_writes_it_and_replaces_none(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    log = log_with(tmp_path, np.zeros((20, 20)))
    page = tmp_path / "start.html"
    assert main(["drive", "start", str(log), "-o", str(page)]) == 0
    assert str(page) in capsys.readouterr().out
    page.write_text("mine", encoding="utf-8")
    assert main(["drive", "start", str(log), "-o", str(page)]) == 2
    assert "--force" in capsys.readouterr().err
    assert page.read_text("utf-8") == "mine"
    assert main(["drive", "start", str(log), "-o", str(page), "--force", "-q"]) == 0
    assert page.read_text("utf-8") != "mine"
