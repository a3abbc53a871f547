"""`veduta facade` on good photos: what lies in OUT afterwards."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
import pytest
from command_line import FILES, facade, read_json, tree, veduta
from PIL import Image

from veduta.facade.document import CLASSES, FacadeDocument


@pytest.fixture(scope="module")
def out(tmp_path_factory: pytest.TempPathFactory, photos: list[Path]) -> Path:
    folder = tmp_path_factory.mktemp("facade") / "out"
    done = facade(*photos[:2], "-o", folder)
    assert (done.returncode, done.stderr.count("error")) == (0, 0), done.stderr
    assert "house0: " in done.stdout
    assert f"veduta view {folder}" in done.stdout
    return folder


def test_all_files_are_there(out: Path) -> None:
    assert {file.name for file in out.iterdir()} == {
        ".veduta", "house0", "house1", "place.json", "report.json", "report.html",
    }  # fmt: skip
    for name in ("house0", "house1"):
        assert {file.name for file in (out / name).iterdir()} == FILES
    assert {file.name for file in (out / ".veduta").iterdir()} == {"run.json", "lock"}


def test_the_same_bytes_alone_and_with_others(
    out: Path, tmp_path: Path, photos: list[Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    """The sums of matrix products depend on the number of threads, which is therefore fixed."""
    monkeypatch.setenv("OPENBLAS_NUM_THREADS", "2")
    assert facade(photos[0], "-o", tmp_path).returncode == 0
    assert tree(tmp_path / "house0") == tree(out / "house0")


def test_labels_are_drawn_from_the_document(out: Path) -> None:
    """Redrawn with OpenCV on a grid of 16 by 16 points per pixel, read at the centres."""
    document = FacadeDocument.model_validate(read_json(out / "house0" / "facade.json"))
    assert read_json(out / "house0" / "facade.json")["classes"] == list(CLASSES)
    labels = Image.open(out / "house0" / "labels.png")
    size = (document.rectification.width_px, document.rectification.height_px)
    assert (labels.mode, labels.size) == ("P", size)

    fine = np.full((size[1] * 16, size[0] * 16), CLASSES.index("other"), dtype=np.uint8)
    for extent in document.extents:
        points = np.rint(np.array(extent.polygon_px) * 16).astype(np.int32)
        cv2.fillPoly(fine, [points], CLASSES.index(extent.class_))
    for item in document.elements:
        left, top = round(item.x_px * 16), round(item.y_px * 16)
        right = round((item.x_px + item.width_px) * 16)
        bottom = round((item.y_px + item.height_px) * 16)
        fine[max(0, top) : max(0, bottom), max(0, left) : max(0, right)] = CLASSES.index(
            item.class_
        )
    redrawn = fine[8::16, 8::16]
    different = np.mean(redrawn != np.asarray(labels))
    assert different < 0.005  # centres within a sixteenth of a pixel of a border


def test_the_documents_metres_agree_with_its_pixels(out: Path) -> None:
    document = FacadeDocument.model_validate(read_json(out / "house0" / "facade.json"))
    scale, box = document.scale.metres_per_px, document.facade
    assert len(document.elements) > 10
    for item in document.elements:
        assert item.x_m == pytest.approx((item.x_px - box.x_px) * scale, abs=1e-3)
        assert item.width_m == pytest.approx(item.width_px * scale, abs=1e-3)
        bottom = box.y_px + box.height_px - item.y_px - item.height_px
        assert item.y_m == pytest.approx(bottom * scale, abs=1e-3)


def test_place_stands_side_by_side_and_says_that_this_is_invented(out: Path) -> None:
    place = read_json(out / "place.json")
    first, second = place["parts"]
    assert (first["id"], second["id"]) == ("house0", "house1")
    assert {first["arrangement"], second["arrangement"]} == {"invented"}
    right = first["bounds"]["max"][0] + first["transform"][12]
    left = second["bounds"]["min"][0] + second["transform"][12]
    assert 1 <= left - right <= 10
    assert place["start"]["eye"][2] == 1.7
    for part in place["parts"]:
        for key in ("model", "city_model", "document", "photo"):
            assert (out / part[key]).is_file()


def test_reports(out: Path) -> None:
    report = read_json(out / "house0" / "report.json")
    names = [step["name"] for step in report["steps"]]
    assert names[:2] == ["read", "rectify"]
    assert names[-2:] == ["model", "write"]
    assert all(step["seconds"] >= 0 for step in report["steps"])
    assert report["options"]["rectify"]["rectified"] is True
    assert report["options"]["model"]["depth_m"] == 10.0
    assert report["failures"] == []
    assert read_json(out / "report.json")["measures"]["done"] == 2
    page = (out / "house0" / "report.html").read_text()
    assert "data:image/jpeg;base64," in page
    assert 'src="http' not in page


def test_a_single_image_is_not_arranged(tmp_path: Path, photo: Path) -> None:
    assert facade(photo, "-o", tmp_path / "out").returncode == 0
    (part,) = read_json(tmp_path / "out" / "place.json")["parts"]
    assert part["arrangement"] == "single"


def test_same_input_same_bytes(tmp_path: Path, out: Path, photos: list[Path]) -> None:
    """Alone and in this process, or with others in a worker: nothing but times differs."""
    assert facade(photos[0], "-o", tmp_path / "out").returncode == 0
    assert tree(tmp_path / "out" / "house0") == tree(out / "house0")


def test_a_folder_stands_for_its_images(tmp_path: Path, photo: Path) -> None:
    folder = tmp_path / "photos"
    folder.mkdir()
    (folder / "a.png").write_bytes(photo.read_bytes())
    (folder / "notes.txt").write_text("not an image")
    Image.new("P", (260, 400)).save(folder / "a.tif")
    done = facade(folder, "-o", tmp_path / "out", "--quiet")
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
    assert (tmp_path / "out" / "a" / "model.glb").is_file()
    told = "left out as a picture of labels, beside the photo of the same name: a.tif"
    assert read_json(tmp_path / "out" / "report.json")["notes"] == [told]
    assert told in facade(folder, "-o", tmp_path / "out").stdout.splitlines()


def test_help_and_version() -> None:
    assert veduta("--version").stdout.startswith("veduta ")
    text = veduta("facade", "--help").stdout
    for option in ("--rectified", "--corners", "--height-m", "--storey-m", "--depth-m", "--out"):
        assert option in text
