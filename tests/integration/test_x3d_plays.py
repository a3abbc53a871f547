"""`house.x3d` in a real browser: X_ITE loads it, doors open and close, lamps go on and off."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from sample_plan import sample_plan

from veduta.place.manifest import Start
from veduta.plan.house.build import build_house
from veduta.plan.lights.lighting import light_house
from veduta.plan.options import HouseOptions
from veduta.plan.outputs.x3d import View, house_x3d
from veduta.plan.surroundings.build import build_surroundings

ROOT = Path(__file__).resolve().parents[2]
PLAYER = Path(__file__).with_name("x3d_player.mjs")


def test_doors_open_and_lamps_go_on_in_x_ite(tmp_path: Path) -> None:
    modules = ROOT / "studio" / "node_modules"
    node = shutil.which("node")
    chromium = os.environ.get("CHROMIUM", "/usr/bin/chromium")
    if node is None or not (modules / "x_ite").is_dir() or not Path(chromium).exists():
        pytest.skip("no X_ITE or no Chromium: make setup, and the package chromium")
    options = HouseOptions()
    house = build_house(light_house(sample_plan(), options).document, options)
    # The front door is in the south wall at x = 1.1 m.
    door = View("Door", (1.1, -1.2, 1.6), (1.1, 3.0, 1.6))
    away = View("Away", (4.0, -14.0, 1.6), (4.0, 0.0, 1.6))
    file, picture = tmp_path / "house.x3d", tmp_path / "inside.png"
    # Who walks falls where there is no ground.
    ground = build_surroundings(house.spaces[0], options).ground
    start = Start(eye=away.eye, target=away.target)
    file.write_bytes(house_x3d(house, options, start, [door, away], others=[ground]))
    done = subprocess.run(
        [node, str(PLAYER), str(modules), str(file), chromium, str(picture)],
        capture_output=True, text=True, check=False, timeout=400,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    told = json.loads(done.stdout)
    assert told == {"before": {"angle": 0, "lamp": False}, "complaints": []}
    colours = np.asarray(Image.open(picture).convert("RGB"), dtype=np.float64).reshape(-1, 3)
    red, _, blue = colours.mean(axis=0)
    assert red > 1.1 * blue  # warm light on walls and boards, and no sky
    seen = colours.mean(axis=1)
    assert seen.std() > 15.0
    assert 60.0 < seen.mean() < 235.0
