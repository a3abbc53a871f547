"""An animal for the demo's street: filmed by code, read from that film, sent through the street."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import cv2

from veduta.fauna.command import run_fauna
from veduta.fauna.options import AnimalOptions, FaunaOptions
from veduta.fauna.recipe import Record
from veduta.run.atomic import atomic_folder, write_bytes
from veduta.run.outputs import writing_to
from veduta.run.progress import Progress
from veduta.run.verb import VerbResult
from veduta.synthetic.animals import film_quadruped

FILM, ANIMAL, WAY = "film", "animal", "way.geojson"
_SEED, _FRAMES, _CYCLE = 100, 22, 16.0
_LENGTH_M = 1.1
_STROLL = ((-10.0, -4.5), (16.0, -4.5), (-9.0, -6.5))
"""Before the demo's fronts, which stand along x from 0 on and look to -y: there, and back again."""


def run_demo_animal(out: Path, progress: Progress, *, force: bool) -> VerbResult:
    """A walking quadruped in the place of OUT: OUT/film has its frames, OUT/way.geojson where it
    goes, OUT/animal the place with it.

    The film is of 22 frames of 360 x 640, with noise and grass; its background is estimated.
    """
    film = out / FILM
    if force and film.is_dir():
        shutil.rmtree(film)
    if not film.is_dir():
        out.mkdir(parents=True, exist_ok=True)
        with writing_to(out), atomic_folder(film) as folder:
            _write_film(folder)
    way = out / WAY
    line = {"type": "LineString", "coordinates": [list(point) for point in _STROLL]}
    with writing_to(out):
        write_bytes(way, json.dumps(line).encode())
    options = FaunaOptions(animal=AnimalOptions(kind="quadruped", length_m=_LENGTH_M))
    record = Record(film, place=out, way=way)
    return run_fauna(record, out / ANIMAL, options, progress, force=force)


def _write_film(folder: Path) -> None:
    """A PNG for each frame; OSError where one cannot be written."""
    filmed = film_quadruped(_SEED, frames=_FRAMES, cycle=_CYCLE)
    for row, frame in enumerate(filmed.frames):
        done, content = cv2.imencode(".png", frame[..., ::-1])
        if not done:
            raise OSError(f"frame {row} of the film is no PNG")
        (folder / f"{row:03d}.png").write_bytes(content.tobytes())
