"""Options that can have no effect are refused, with the other that makes them idle; others pass."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from veduta.cli.arguments import parse
from veduta.cli.photos_call import PhotosCall
from veduta.photos.city.reading import read_city_model
from veduta.photos.idle_options import require_effect
from veduta.photos.options import ModelOptions
from veduta.run.errors import InputError

GIVEN = "--from-colmap sparse"
MODEL = "--model town.gml"


def check(words: str) -> None:
    call = parse(PhotosCall, "veduta photos", ["photos", "-o", "out", *words.split()])
    require_effect(call.options(), call.given())


@pytest.mark.parametrize(
    ("beside", "idle", "named"),
    [
        (GIVEN, "--lens radial", "--from-colmap"),
        (GIVEN, "--cameras shared", "--from-colmap"),
        (GIVEN, "--principal-point free", "--from-colmap"),
        (GIVEN, "--epipolar lmeds", "--from-colmap"),
        (GIVEN, "--pairs all", "--from-colmap"),
        (GIVEN, "--neighbours 3", "--from-colmap"),
        (GIVEN, "--max-side-px 640", "--from-colmap"),
        (GIVEN, "--max-features 600", "--from-colmap"),
        (GIVEN, "--mapping global", "--from-colmap"),
        ("", "--video-interval-s 2", "--video"),
        ("", "--video-frames 20", "--video"),
        ("--pairs all", "--neighbours 3", "--pairs all"),
        ("--no-walls", "--wall-points 50", "--no-walls"),
        ("--no-walls", "--wall-side-px 512", "--no-walls"),
        ("--georef model " + MODEL, "--gcp points.txt", "--georef model"),
        ("--georef gps", "--gcp points.txt", "--georef gps"),
        ("--georef off", "--gcp points.txt", "--georef off"),
        ("--georef off", MODEL, "--georef off"),
        ("", "--crs EPSG:25832", "--model"),
        ("", "--layer lots", "--model"),
        ("", "--height-attribute top", "--model"),
        ("--gcp points.txt", "--model-up y", "--model"),
        ("", "--no-texture", "--model"),
        ("", "--texel-m 0.01", "--model"),
        ("", "--max-atlas-px 512", "--model"),
        ("--no-texture " + MODEL, "--texel-m 0.01", "--no-texture"),
        ("--no-texture " + MODEL, "--max-atlas-px 512", "--no-texture"),
    ],
)
def test_what_has_no_effect_is_refused(beside: str, idle: str, named: str) -> None:
    """Neither of the two alone is refused for that; together they are, and both are named."""
    check(beside)
    with pytest.raises(InputError) as refused:
        check(f"{beside} {idle}")
    assert refused.value.subject == idle.split()[0]
    assert named in f"{refused.value.fault} {refused.value.remedy}"


@pytest.mark.parametrize(
    "words",
    [
        "--lens radial --cameras shared --pairs sequence --neighbours 3 --epipolar magsac",
        f"{GIVEN} --lens auto --seed 3 --wall-points 50 {MODEL} --texel-m 0.01",
        "--video walk.mp4 --video-frames 20 --video-interval-s 2",
        f"{MODEL} --crs EPSG:25832 --layer lots --height-attribute top --no-walls --gcp p.txt",
        f"--georef gcp --gcp p.txt {MODEL} --max-atlas-px 512",
        f"--georef gps {MODEL} --texel-m 0.01",  # the place then lies in the model's system
    ],
)
def test_what_has_an_effect_passes(words: str) -> None:
    check(words)


@pytest.mark.parametrize(
    ("options", "subject"),
    [
        ({"layer": "lots"}, "--layer"),
        ({"height_attribute": "top"}, "--height-attribute"),
        ({"model_up": "z"}, "--model-up"),
    ],
)
def test_options_about_models_of_another_kind(
    tmp_path: Path, options: dict[str, str], subject: str
) -> None:
    path = tmp_path / "town.city.json"
    path.write_text(json.dumps({"type": "CityJSON", "version": "2.0", "CityObjects": {}}))
    with pytest.raises(InputError) as refused:
        read_city_model(path, ModelOptions.model_validate({"crs": "EPSG:25832", **options}))
    assert refused.value.subject == subject
    assert "town.city.json is CityJSON" in refused.value.fault
