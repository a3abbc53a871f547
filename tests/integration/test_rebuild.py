"""An edited facade.json becomes a model again; a broken one says where it is broken."""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from command_line import FILES, facade, read_json, refused, tree, veduta
from PIL import Image

from veduta.facade.document import CLASSES


@pytest.fixture
def out(tmp_path: Path, two_houses: Path) -> Path:
    return Path(shutil.copytree(two_houses, tmp_path / "out"))


def edit(path: Path, change: Callable[[Any], None]) -> None:
    content = read_json(path)
    change(content)
    path.write_text(json.dumps(content))


def first_window(content: Any) -> int:
    return next(i for i, item in enumerate(content["elements"]) if item["class"] == "window")


def widen_first_window(content: Any) -> None:
    index = first_window(content)
    content["elements"][index]["height_px"] += 5
    content["elements"][index]["y_px"] -= 5


def test_untouched_gives_the_same_bytes(out: Path, tmp_path: Path) -> None:
    new = tmp_path / "new"
    done = veduta("facade", out / "house0" / "facade.json", "-o", new)
    assert done.returncode == 0, done.stderr
    assert {file.name for file in (new / "house0").iterdir()} == FILES
    assert tree(new / "house0") == tree(out / "house0")


def test_in_place(out: Path, photos: list[Path]) -> None:
    before = tree(out)
    document = out / "house0" / "facade.json"
    edit(document, widen_first_window)
    edited = document.read_bytes()
    done = veduta("facade", document, "-o", out)
    assert done.returncode == 0, done.stderr
    after = tree(out)
    assert document.read_bytes() == edited
    for name in ("labels.png", "overlay.png", "model.glb", "model.city.json"):
        assert after[f"house0/{name}"] != before[f"house0/{name}"]
        assert after[f"house1/{name}"] == before[f"house1/{name}"]
    assert len(read_json(out / "place.json")["parts"]) == 2
    again = veduta("facade", document, "-o", out)
    assert "up to date" in again.stdout
    kept = facade(*photos[:2], "-o", out, "--force")
    assert kept.returncode == 0
    assert f"{document}: was edited" in kept.stdout
    assert tree(out) == after


def test_it_is_told_whose_numbers_are_told(out: Path, photos: list[Path]) -> None:
    """Of before the edit, of the edited document, or of another one than lies there now."""
    document = out / "house0" / "facade.json"
    found = document.read_bytes()
    windows = sum(item["class"] == "window" for item in read_json(document)["elements"])
    edit(document, lambda content: content["elements"].pop(first_window(content)))
    command = f"; to rebuild from it: veduta facade {document} -o {out}"

    before = facade(*photos[:2], "-o", out).stdout.splitlines()
    assert f" {windows} windows" in before[0]
    assert before[0].endswith(" (was done, before facade.json was changed)")
    (other,) = (line for line in before if line.startswith("house1: "))
    assert other.endswith(" (was done)")
    assert f"{document}: was edited and is left as it is{command}" in before

    assert veduta("facade", document, "-o", out).returncode == 0
    for force in ([], ["--force"]):
        after = facade(*photos[:2], "-o", out, *force).stdout.splitlines()
        assert f" {windows - 1} windows" in after[0]
        assert after[0].endswith(" (was rebuilt from the edited facade.json)")
        assert f"{document}: was edited and is left as it is" in after
    notes = read_json(out / "report.json")["notes"]
    assert notes == ["house0/facade.json was edited and is left as it is"]

    document.write_bytes(found)
    back = facade(*photos[:2], "-o", out).stdout.splitlines()
    assert f" {windows - 1} windows" in back[0]
    assert back[0].endswith(" (was done, before facade.json was changed)")
    assert f"{document}: is another than the model was made from{command}" in back


def test_pixels_decide_over_metres(out: Path, tmp_path: Path) -> None:
    document = out / "house0" / "facade.json"
    edit(document, widen_first_window)
    new = tmp_path / "new"
    assert veduta("facade", document, "-o", new).returncode == 0
    content = read_json(new / "house0" / "facade.json")
    window = next(item for item in content["elements"] if item["class"] == "window")
    scale = content["scale"]["metres_per_px"]
    assert window["height_m"] == pytest.approx(window["height_px"] * scale)
    assert any("elements[" in note for note in content["notes"])
    labels = np.asarray(Image.open(new / "house0" / "labels.png"))
    top = int(np.ceil(window["y_px"] - 0.5))
    middle = int(window["x_px"] + window["width_px"] / 2)
    assert labels[top, middle] == CLASSES.index("window")


def test_what_does_not_fit_the_model_is_told(out: Path, tmp_path: Path) -> None:
    document = out / "house0" / "facade.json"

    def twice(content: Any) -> None:
        windows = [item for item in content["elements"] if item["class"] == "window"]
        content["elements"].append(windows[0])

    edit(document, twice)
    done = veduta("facade", document, "-o", tmp_path / "new")
    page = tmp_path / "new" / "house0" / "report.html"
    (line,) = (one for one in done.stdout.splitlines() if "element" in one)
    assert line.strip().startswith("1 element left out")
    assert line.endswith(f": {page}")
    assert "left out, no room" in page.read_text()
    assert read_json(page.with_suffix(".json"))["measures"]["left_out"] == 1


def test_a_model_that_was_edited_is_named_and_kept(out: Path) -> None:
    """A rebuild cannot make it follow the document, and must not let it pass for a part of it."""
    document, model = out / "house0" / "facade.json", out / "house0" / "model.glb"
    model.write_bytes(model.read_bytes() + b"mine")
    mine = model.read_bytes()
    edit(document, set_at("model", "setback_m", value=0.35))
    done = veduta("facade", document, "-o", out)
    assert f"{model}: was edited and is left as it is: it does not follow" in done.stdout
    assert model.read_bytes() == mine
    model.unlink()
    done = veduta("facade", document, "-o", out)
    assert "left as it is" not in done.stdout
    assert model.is_file()


def test_force_rebuilds_what_is_up_to_date(out: Path) -> None:
    document = out / "house0" / "facade.json"
    assert veduta("facade", document, "-o", out).returncode == 0
    assert "up to date; --force" in veduta("facade", document, "-o", out).stdout
    before = (out / "house0" / "model.glb").stat().st_mtime_ns
    done = veduta("facade", document, "-o", out, "--force")
    assert "up to date" not in done.stdout
    assert (out / "house0" / "model.glb").stat().st_mtime_ns > before


SIZES = ("--depth-m", 7, "--setback-m", 0.35)
KINDS = {"detail": "library"}


def test_a_rebuild_keeps_the_sizes_of_the_run_that_made_it(tmp_path: Path, photo: Path) -> None:
    out, new, other = tmp_path / "out", tmp_path / "new", tmp_path / "other"
    assert facade(photo, "-o", out, *SIZES).returncode == 0
    document = out / "house0" / "facade.json"
    assert read_json(document)["model"] == {"depth_m": 7.0, "setback_m": 0.35, **KINDS}
    assert veduta("facade", document, "-o", new).returncode == 0
    assert tree(new / "house0") == tree(out / "house0")
    assert read_json(new / "report.json")["options"] == {}
    assert veduta("facade", document, "-o", other, "--depth-m", 8).returncode == 0
    call = read_json(other / "report.json")
    assert call["options"] == {"depth_m": 8.0}
    assert call["notes"] == ["rebuilt from facade.json: house0"]
    rebuilt = read_json(other / "house0" / "facade.json")
    assert rebuilt["model"] == {"depth_m": 8.0, "setback_m": 0.35, **KINDS}
    report = read_json(other / "house0" / "report.json")
    assert report["options"] == rebuilt["model"]
    assert depth_of(other / "house0") == pytest.approx(8.0)


def depth_of(folder: Path) -> float:
    city = read_json(folder / "model.city.json")
    extent = city["metadata"]["geographicalExtent"]
    return float(extent[4])


def test_sizes_that_are_asked_for_in_place_are_kept(out: Path) -> None:
    document = out / "house0" / "facade.json"
    ask = ("facade", document, "-o", out, "--depth-m", 7)
    assert veduta(*ask).returncode == 0
    assert read_json(document)["model"]["depth_m"] == 7.0
    assert depth_of(out / "house0") == pytest.approx(7.0)
    assert "up to date" in veduta(*ask).stdout
    before = tree(out)
    assert veduta("facade", document, "-o", out).returncode == 0
    assert tree(out) == before


def test_a_photos_call_knows_that_its_result_was_rebuilt_otherwise(
    out: Path, photos: list[Path]
) -> None:
    document = out / "house0" / "facade.json"
    assert veduta("facade", document, "-o", out, "--depth-m", "20").returncode == 0
    again = facade(*photos[:2], "-o", out)
    assert again.returncode == 2
    assert "holds the finished result of other inputs or options" in again.stderr
    assert read_json(document)["model"]["depth_m"] == 20
    assert facade(*photos[:2], "-o", out, "--force").returncode == 0
    assert read_json(document)["model"]["depth_m"] == 10


def test_an_edited_document_is_not_written_to(out: Path) -> None:
    document = out / "house0" / "facade.json"
    edit(document, set_at("model", "depth_m", value=6.0))
    edited = document.read_bytes()
    assert veduta("facade", document, "-o", out).returncode == 0
    assert depth_of(out / "house0") == pytest.approx(6.0)
    ask = ("facade", document, "-o", out, "--depth-m", 7)
    assert veduta(*ask).returncode == 0
    assert depth_of(out / "house0") == pytest.approx(7.0)
    assert document.read_bytes() == edited
    assert "up to date" in veduta(*ask).stdout


def test_a_document_of_before_the_sizes_has_the_defaults(out: Path, tmp_path: Path) -> None:
    document = out / "house0" / "facade.json"
    edit(document, lambda content: content.pop("model"))
    assert veduta("facade", document, "-o", tmp_path / "new").returncode == 0
    assert tree(tmp_path / "new" / "house0") == tree_without_edit(out / "house0")


def tree_without_edit(folder: Path) -> dict[str, bytes]:
    """The files of a result as they were before its document was edited."""
    files = tree(folder)
    content = json.loads(files["facade.json"])
    place = list(content).index("facade") + 1
    items = list(content.items())
    items.insert(place, ("model", {"depth_m": 10.0, "setback_m": 0.2, **KINDS}))
    files["facade.json"] = (json.dumps(dict(items), indent=1, ensure_ascii=False) + "\n").encode()
    return files


def set_at(*path: str | int, value: Any) -> Callable[[Any], None]:
    def change(content: Any) -> None:
        for step in path[:-1]:
            content = content[step]
        content[path[-1]] = value

    return change


@pytest.mark.parametrize(
    ("change", "place"),
    [
        (set_at("elements", 3, "width_px", value="wide"), "elements[3].width_px: "),
        (set_at("elements", 3, "width_px", value="12"), "elements[3].width_px: "),
        (set_at("elements", 3, "width_px", value=True), "elements[3].width_px: "),
        (set_at("elements", 3, "class", value="windwo"), "elements[3].class: "),
        (set_at("elements", 3, "colour", value="red"), "elements[3].colour: "),
        (set_at("elements", 3, "width_px", value=-1), "elements[3].width_px: "),
        (set_at("elements", 0, "x_px", value=float("inf")), "elements[0].x_px: "),
        (set_at("elements", 0, "x_px", value=1e30), "elements[0].x_px: "),
        (set_at("extents", 0, "polygon_px", value=[[0, 0]]), "extents[0].polygon_px: "),
        (set_at("scale", "metres_per_px", value=0), "scale.metres_per_px: "),
        (set_at("version", value=7), "version: "),
        (set_at("storeys", value=0), "storeys: "),
        (set_at("model", "depth_m", value=0), "model.depth_m: "),
        (set_at("model", "setback_m", value=1.5), "model.setback_m: "),
        (set_at("classes", value=["window"]), "classes: "),
        (set_at("rectification", "width_px", value=20), "rectified.jpg: is "),
    ],
)
def test_a_broken_document_says_where(out: Path, change: Callable[[Any], None], place: str) -> None:
    before = tree(out)
    document = out / "house0" / "facade.json"
    edit(document, change)
    done = refused("facade", document, "-o", out)
    assert done.returncode == 2, done.stdout
    assert place in done.stderr
    assert done.stderr.startswith(f"error: {document.parent}")
    after = tree(out)
    assert {name for name in after if after[name] != before[name]} == {"house0/facade.json"}


def test_not_json(out: Path) -> None:
    document = out / "house0" / "facade.json"
    document.write_text('{\n "schema": "veduta/facade",\n "version" 1\n}')
    done = refused("facade", document, "-o", out)
    assert done.returncode == 2
    assert "line 3" in done.stderr


def test_a_number_of_too_many_digits(out: Path) -> None:
    path = out / "house0" / "facade.json"
    path.write_text(path.read_text().replace('"version": 1', '"version": ' + 5000 * "9"))
    done = refused("facade", path, "-o", out)
    assert done.returncode == 2
    assert f"error: {path}: is not usable JSON" in done.stderr


def test_photo_is_missing(out: Path, tmp_path: Path) -> None:
    (out / "house0" / "rectified.jpg").unlink()
    done = refused("facade", out / "house0" / "facade.json", "-o", tmp_path / "new")
    assert done.returncode == 2
    assert "rectified.jpg: does not exist" in done.stderr


def test_options_of_photos_are_refused(out: Path, tmp_path: Path) -> None:
    document = out / "house0" / "facade.json"
    done = refused("facade", document, "-o", tmp_path / "new", "--height-m", "20")
    assert done.returncode == 2
    assert "--height-m" in done.stderr
    assert veduta("facade", document, "-o", tmp_path / "new", "--depth-m", "7").returncode == 0


def _with_second_house(out: Path) -> None:
    """Make the photo of house0 one of two houses, as its run would have left them."""
    house = out / "house0" / "house-2"
    shutil.copytree(out / "house0", house)
    path = out / ".veduta" / "run.json"
    record = read_json(path)
    files = {name: digest for name, digest in record["files"].items() if "house0/" in name}
    moved = {name.replace("house0/", "house0/house-2/", 1): files[name] for name in files}
    record["files"] |= moved
    summary = record["items"]["house0"]["summary"]
    summary["beside"] = [
        {
            "folder": "house-2",
            "storeys": summary["storeys"],
            "offset_m": 20.0,
            "bounds_min": summary["bounds_min"],
            "bounds_max": summary["bounds_max"],
        }
    ]
    path.write_text(json.dumps(record))


def test_a_rebuild_in_place_leaves_the_other_houses(out: Path) -> None:
    _with_second_house(out)
    before = tree(out / "house0" / "house-2")
    model = (out / "house0" / "model.glb").read_bytes()
    done = veduta("facade", out / "house0" / "facade.json", "-o", out, "--setback-m", "0.31")
    assert done.returncode == 0, done.stderr
    assert "1 more house of the photo: house-2" in done.stdout
    assert (out / "house0" / "model.glb").read_bytes() != model
    assert tree(out / "house0" / "house-2") == before
    parts = [part["id"] for part in read_json(out / "place.json")["parts"]]
    assert parts == ["house0", "house0-house-2", "house1"]
    kept = read_json(out / ".veduta" / "run.json")
    assert "house0/house-2/facade.json" in kept["files"]
    assert kept["items"]["house0"]["summary"]["beside"][0]["folder"] == "house-2"
