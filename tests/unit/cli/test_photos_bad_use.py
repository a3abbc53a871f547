"""Bad use of `veduta photos`: what is wrong and what to do is told, and no OUT is left."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from veduta.cli.main import main

GCP = """EPSG:25832
500001 5500002 3 10 10 vew0.png a
500001 5500002 3 10 10 view1.png a
500005 5500006 7 1 1 VIEW0.png b
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Photos in `in/ner`, one in `one`, two that are not read in `phone`, none in `empty`."""
    made = tmp_path_factory.mktemp("bad use")
    for name in ("in/ner", "one", "phone", "empty"):
        (made / name).mkdir(parents=True)
    noise = np.random.default_rng(0).integers(0, 256, (2, 90, 120, 3), dtype=np.uint8)
    for number in range(2):
        Image.fromarray(noise[number]).save(made / "in" / "ner" / f"view{number}.png")
        (made / "phone" / f"{number}.CR2").write_bytes(b"II*")
    Image.fromarray(noise[0]).save(made / "one" / "a.png")
    (made / "gcp.txt").write_text(GCP)
    return made


CALLS = {
    "no folder": ("", "DIR: is not given. Name a folder of photos, or a film"),
    "two folders": ("{}/one {}/in", "in: is given beside another: the verb takes one folder"),
    "a file": ("{}/one/a.png", "is a file, not a folder. Name the folder that it lies in"),
    "empty": ("{}/empty", "holds no photos. Put at least two photos"),
    "one photo": ("{}/one", "holds one photo. Put at least two photos"),
    "folders in it": ("{}/in", "in/ner, which holds some: folders in folders are not looked into"),
    "of a telephone": ("{}/phone", "holds no photos. Save 0.CR2 and the others as JPEG"),
    "no effect": ("{}/in/ner --texel-m 0.1", "--texel-m: is about a city model, and there is no"),
    "lens": ("{}/in/ner --lens fish", '--lens: "fish" is not among its values. Give auto, pinhole'),
    "misspelt marks": (
        "{}/in/ner --gcp {}/gcp.txt",
        "marks 0 of its 2 points in two photos that are there, and it takes 3 (line 2: vew0.png is"
        " not among the photos, where view0.png is; line 4: VIEW0.png is not among",
    ),
    "no model": ("{}/in/ner --model {}/gcp.txt", "gcp.txt: is no city model that can be read"),
    "georef": ("{}/in/ner --georef model", "asks for --model, which is not given. Add --model"),
}


@pytest.mark.parametrize("name", CALLS)
def test_bad_use_is_told(
    folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], name: str
) -> None:
    words, told = CALLS[name]
    arguments = [word.replace("{}", str(folder)) for word in words.split()]
    assert main(["photos", *arguments, "-o", str(tmp_path / "out")]) == 2
    error = capsys.readouterr().err
    assert error.startswith("error: ")
    assert told in error.replace(f"{folder}/", "")
    assert error.count("\n") == 1
    assert not (tmp_path / "out").exists()
