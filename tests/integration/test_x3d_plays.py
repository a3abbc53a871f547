"""`house.x3d` in a real browser: X_ITE loads it, doors open and close, lamps go on and off.

Without a graphics card it takes minutes: it runs where VEDUTA_PLAY_X3D is set, and not in CI.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
from pathlib import Path

import pytest
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
    if "VEDUTA_PLAY_X3D" not in os.environ:
        pytest.skip("takes minutes without a graphics card: set VEDUTA_PLAY_X3D=1")
    modules = ROOT / "studio" / "node_modules"
    node = shutil.which("node")
    chromium = os.environ.get("CHROMIUM", "/usr/bin/chromium")
    if node is None or not (modules / "x_ite").is_dir() or not Path(chromium).exists():
        pytest.skip("no X_ITE or no Chromium: make setup, and the package chromium")
    options = HouseOptions()
    house = build_house(light_house(sample_plan(), options).document, options)
    # The front door is in the south wall at x = 1.1 m.
    door = View("Door", (1.1, -1.2, 1.6), (1.1, 3.0, 1.6))
    away = View("Away", (4.0, -10.0, 1.6), (4.0, 0.0, 1.6))
    file = tmp_path / "house.x3d"
    # Who walks falls where there is no ground.
    ground = build_surroundings(house.spaces[0], options).ground
    start = Start(eye=away.eye, target=away.target)
    file.write_bytes(house_x3d(house, options, start, [door, away], others=[ground]))
    done = subprocess.run(
        [node, str(PLAYER), str(modules), str(file), chromium],
        capture_output=True, text=True, check=False, timeout=900,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    told = json.loads(done.stdout)
    assert told == {"before": {"angle": 0, "lamp": False}, "complaints": []}
