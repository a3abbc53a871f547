"""Each verb, and what it leaves, where no name is UTF-8: of folders, of files, of OUT.

The same calls prove that no verb looks up a host: all ways to the network are trapped meanwhile.
"""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from command_line import veduta
from drawn_dxf import saved, two_rooms
from drawn_footage import band_footage
from photo_scene import write_photos
from PIL import Image
from rows_of_houses import write_row
from stereo_scene import write_set
from trapped_names import compiled_trap, looked_up, trapped_environment

from veduta.cli.main import main
from veduta.synthetic.drives import StreetOptions, TruckOptions, build_street, scan_street
from veduta.synthetic.drives.write import write_drive
from veduta.synthetic.walks.record import GorgeWalk, write_walk

sys.path.append(str(Path(__file__).parents[1] / "unit" / "carve"))
from ring_of_a_ball import write_ring

BAD = os.fsdecode(b"\xe9")
RULES = 'import a : "inner.cga"\nLot --> a.Lot\n'
INNER = """Lot --> extrude(9) comp(f) { side : Side | top : X. }
Side --> setupProjection(0, scope.xy, 2, 2) texture("tex.png") projectUV(0)
"""


def _facade(folder: Path, photo: Path) -> list[object]:
    shutil.copy(photo, folder / f"maison{BAD}.png")
    return ["facade", folder / f"maison{BAD}.png", "--rectified", "--eyes", "plain"]


def _grammar(folder: Path, photo: Path) -> list[object]:
    (folder / f"m{BAD}.cga").write_text(RULES)
    (folder / "inner.cga").write_text(INNER)
    Image.new("RGB", (8, 8), (200, 90, 60)).save(folder / "tex.png")
    write_row(folder / f"lots{BAD}.geojson", 2)
    return [
        "grammar", "derive", folder / f"m{BAD}.cga", "--lots", folder / f"lots{BAD}.geojson",
    ]  # fmt: skip


def _plan(folder: Path, photo: Path) -> list[object]:
    saved(two_rooms(), folder / "rooms.dxf")
    (folder / "rooms.dxf").rename(folder / f"rooms{BAD}.dxf")
    return ["plan", folder / f"rooms{BAD}.dxf", "--surroundings", "none"]


def _photos(folder: Path, photo: Path) -> list[object]:
    write_photos(folder)
    (folder / "view1.png").rename(folder / f"view1{BAD}.png")
    return [
        "photos", folder, "--lens", "pinhole", "--cameras", "shared", "--principal-point",
        "middle", "--max-features", "1500",
    ]  # fmt: skip


def _carve(folder: Path, photo: Path) -> list[object]:
    write_ring(folder.with_name("ball"), masks=True)  # OpenCV crashes at such a name
    shutil.move(folder.with_name("ball"), folder / "ball")
    return ["carve", folder / "ball", "--levels", "5"]


def _dense(folder: Path, photo: Path) -> list[object]:
    shutil.move(write_set(folder.with_name("wall")), folder / "wall")
    return ["dense", folder / "wall", "--no-mesh"]


def _drive(folder: Path, photo: Path) -> list[object]:
    street = build_street(StreetOptions(length_m=20.0), 4)
    write_drive(scan_street(street, TruckOptions(), 4), folder.with_name("street"))
    shutil.move(folder.with_name("street"), folder / "street")
    return ["drive", folder / "street"]


def _walk(folder: Path, photo: Path) -> list[object]:
    write_walk(folder, GorgeWalk(keys=2, step_m=1.5, width_px=192, height_px=128))
    return ["walk", folder]


def _fauna(folder: Path, photo: Path) -> list[object]:
    (folder / "film").mkdir()
    for number, pixels in enumerate(np.asarray(band_footage())):
        Image.fromarray(pixels).save(folder / "film" / f"{number:03d}{BAD}.png")
    return ["fauna", folder / "film"]


CALLS: dict[str, Callable[[Path, Path], list[object]]] = {
    "facade": _facade, "grammar": _grammar, "plan": _plan, "photos": _photos, "carve": _carve,
    "dense": _dense, "drive": _drive, "walk": _walk, "fauna": _fauna,
}  # fmt: skip


@pytest.fixture(scope="module")
def trap(tmp_path_factory: pytest.TempPathFactory) -> Path | None:
    return compiled_trap(tmp_path_factory.mktemp("trap"))


@pytest.mark.slow
@pytest.mark.parametrize("verb", CALLS)
def test_a_verb_reads_and_writes_such_names(
    verb: str, photo: Path, tmp_path: Path, trap: Path | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path / f"in{BAD}"
    folder.mkdir()
    words = [str(word) for word in CALLS[verb](folder, photo)]
    out = tmp_path / f"new{BAD}" / f"out{BAD}"
    with monkeypatch.context() as patch:
        if trap is not None:
            for name, value in trapped_environment(trap, tmp_path).items():
                patch.setenv(name, value)
            patch.delenv("ORT_DISABLE_TELEMETRY", raising=False)
        done = veduta(*words, "-o", out)
    assert done.returncode == 0, done.stderr
    assert trap is None or looked_up(tmp_path) == ""
    assert os.fsencode(out).endswith(b"new\xe9/out\xe9")
    assert r"new\xe9/out\xe9'" in done.stdout
    assert "veduta-names" not in done.stdout + done.stderr
    files = [path for path in out.rglob("*") if path.is_file()]
    assert {"place.json", "report.json"} <= {path.name for path in files}
    for path in files:  # what stands in OUT is UTF-8, and names nothing that is gone
        str(path.relative_to(out)).encode()
        assert b"veduta-names" not in path.read_bytes(), path.name
    assert "is up to date" in veduta(*words, "-o", out).stdout


def test_a_place_is_exported_to_such_a_name(
    one_house: Path, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    place = tmp_path / f"place{BAD}"
    shutil.copytree(one_house, place)
    assert main(["export", str(place), str(tmp_path / f"a{BAD}.obj")]) == 0
    assert (tmp_path / f"a{BAD}.obj").read_text().startswith("#")
    assert main(["export", str(place), str(tmp_path / f"a{BAD}.obj")]) == 2
    assert r"a\xe9.obj': is there already" in capfd.readouterr().err
    assert main(["export", str(place), "--web", str(tmp_path / f"web{BAD}")]) == 0
    assert (tmp_path / f"web{BAD}" / "index.html").is_file()


def test_rules_of_such_a_name_are_formatted(tmp_path: Path) -> None:
    path = tmp_path / f"m{BAD}.cga"
    path.write_text("Lot-->extrude( 9 )")
    assert main(["grammar", "format", str(path), "--write"]) == 0
    assert path.read_text() == "Lot --> extrude(9)\n"
    assert [one.name for one in tmp_path.iterdir()] == [path.name]


def test_a_file_that_is_not_there_is_named(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    none = str(tmp_path / f"none{BAD}.png")
    assert main(["facade", none, "-o", str(tmp_path / f"out{BAD}")]) == 2
    assert r"none\xe9.png: does not exist" in capfd.readouterr().err
    assert not list(tmp_path.iterdir())
