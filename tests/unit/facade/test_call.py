"""What a call is asked to do: which files, under which names."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from veduta.facade.call import plan_call
from veduta.facade.label_pictures import labels_note
from veduta.facade.load import MAX_BYTES
from veduta.imaging.read import MAX_FILE_BYTES
from veduta.run.errors import InputError


def touch(path: Path, content: str = "x") -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(content)
    return path


def test_order_folders_and_doubles(tmp_path: Path) -> None:
    for name in ("b.JPG", "a.png", "notes.txt", "deep/c.jpg"):
        touch(tmp_path / name)
    call = plan_call([tmp_path / "b.JPG", tmp_path, tmp_path / "deep" / ".." / "a.png"])
    assert [source.name for source in call.inputs] == ["b", "a"]
    assert call.kind == "photo"


def test_a_document_is_named_after_its_folder(tmp_path: Path) -> None:
    document = touch(tmp_path / "house" / "facade.json")
    touch(tmp_path / "house" / "rectified.jpg", "photo")
    (source,) = plan_call([document]).inputs
    assert (source.name, source.kind, len(source.digests)) == ("house", "document", 2)


def test_the_identity_is_content_and_name(tmp_path: Path) -> None:
    one = plan_call([touch(tmp_path / "1" / "a.jpg")]).inputs[0].identity
    assert one == plan_call([touch(tmp_path / "2" / "a.jpg")]).inputs[0].identity
    assert one != plan_call([touch(tmp_path / "3" / "a.jpg", "y")]).inputs[0].identity
    assert one != plan_call([touch(tmp_path / "4" / "b.jpg")]).inputs[0].identity


def test_refused(tmp_path: Path) -> None:
    photo = touch(tmp_path / "a.jpg")
    document = touch(tmp_path / "house" / "facade.json")
    touch(tmp_path / "house" / "rectified.jpg")
    empty = tmp_path / "empty"
    empty.mkdir()
    large = touch(tmp_path / "large.jpg")
    os.truncate(large, MAX_FILE_BYTES + 1)
    long = touch(tmp_path / "long" / "facade.json")
    os.truncate(long, MAX_BYTES + 1)
    loop = tmp_path / "loop" / "facade.json"
    loop.parent.mkdir()
    loop.symlink_to(loop)
    for paths, fault in [
        ([], "no image"),
        ([large], r"large.jpg: is 1 GB large, more than 1 GB"),
        ([long], r"facade.json: is 20 MB large, more than 20 MB"),
        ([loop], r"facade.json: cannot be read \(Too many levels"),
        ([tmp_path / (300 * "a") / "x.jpg"], r"cannot be read \(File name too long"),
        ([tmp_path / "none.jpg"], "does not exist"),
        ([empty], "without images"),
        ([photo, document], "between photos"),
        ([photo, touch(tmp_path / "b" / "a.png")], "same name"),
        ([touch(tmp_path / "place.json.jpg")], "cannot name"),
    ]:
        with pytest.raises(InputError, match=fault):
            plan_call(paths)


def test_other_json_of_a_result_is_told_from_documents(tmp_path: Path) -> None:
    place = touch(tmp_path / "place.json", "{}")
    with pytest.raises(InputError, match=r"stand, and is no document of a facade. Give the facade"):
        plan_call([place])
    one = touch(tmp_path / "a" / "facade.json")
    with pytest.raises(InputError) as raised:
        plan_call([place])
    assert raised.value.subject == str(place)
    assert raised.value.remedy == f"Give the document of its building: {one}"
    two = touch(tmp_path / "b" / "facade.json")
    with pytest.raises(InputError, match=rf"one of its buildings, such as {one}$"):
        plan_call([place])
    with pytest.raises(InputError, match=rf"went, .* of its building: {two}$"):
        plan_call([touch(tmp_path / "b" / "report.json")])
    with pytest.raises(InputError, match=rf"a model .* of its building: {one}$"):
        plan_call([touch(tmp_path / "a" / "model.city.json")])


def test_a_document_without_its_photo(tmp_path: Path) -> None:
    document = touch(tmp_path / "house" / "changed.json")
    with pytest.raises(InputError) as raised:
        plan_call([document])
    assert raised.value.subject == str(tmp_path / "house" / "rectified.jpg")
    assert raised.value.remedy == "It must lie beside changed.json as it was written."


def drawn(path: Path, colours: int, mode: str = "RGB") -> Path:
    """A picture with so many colours, stored without loss."""
    path.parent.mkdir(parents=True, exist_ok=True)
    values = np.arange(90 * 90).reshape(90, 90) % colours
    pixels = np.stack([values % 256, values // 256, values * 0], axis=2).astype(np.uint8)
    image = Image.fromarray(pixels[:, :, 0] if mode == "L" else pixels)
    (image.quantize(colours) if mode == "P" else image.convert(mode)).save(path)
    return path


@pytest.mark.parametrize("mode", ["RGB", "P", "RGBA", "L"])
def test_labels_beside_the_photos_of_a_folder_are_left_out(tmp_path: Path, mode: str) -> None:
    for name in ("a", "b"):
        drawn(tmp_path / f"{name}.tif", 8000)
        drawn(tmp_path / f"{name}.png", 12, mode)
    alone = drawn(tmp_path / "alone.png", 12)
    call = plan_call([tmp_path])
    assert [source.path.name for source in call.inputs] == ["a.tif", "alone.png", "b.tif"]
    assert [path.name for path in call.left_out] == ["a.png", "b.png"]
    # Whoever names a file means it.
    assert plan_call([alone, tmp_path / "a.png"]).left_out == ()


@pytest.mark.parametrize(("tif", "png"), [(8000, 8000), (12, 12), (8000, 200)])
def test_which_of_two_is_meant_is_for_the_user_to_say(tmp_path: Path, tif: int, png: int) -> None:
    """Two photos, two pictures of labels, or a grey photo, which has few colours too."""
    drawn(tmp_path / "a.tif", tif)
    drawn(tmp_path / "a.png", png, "L" if png == 200 else "RGB")
    with pytest.raises(InputError) as raised:
        plan_call([tmp_path])
    assert raised.value.subject == str(tmp_path / "a.tif")
    assert (
        raised.value.remedy == f"Name one of them, for instance by {tmp_path}/*.png, or rename it."
    )
    assert len(plan_call([tmp_path / "a.png"]).inputs) == 1


def test_a_damaged_file_is_no_picture_of_labels(tmp_path: Path) -> None:
    whole = drawn(tmp_path / "a.png", 12).read_bytes()
    drawn(tmp_path / "a.tif", 8000)
    (tmp_path / "a.png").write_bytes(whole[: len(whole) // 2])
    with pytest.raises(InputError, match="same name"):
        plan_call([tmp_path])


def test_many_left_out_are_counted_and_named_in_the_report() -> None:
    files = [Path(f"photos/{number}.png") for number in range(5)]
    assert labels_note(files, whole=False).endswith("names: 0.png, 1.png, 2.png and 2 more")
    assert labels_note(files, whole=True).endswith("0.png, 1.png, 2.png, 3.png, 4.png")
    assert labels_note(files[:1], whole=False).endswith("of the same name: 0.png")
