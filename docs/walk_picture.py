"""The moving picture of `docs/walk.md`: a walk through a synthetic gorge, from five stereo pairs.

`python docs/walk_picture.py` writes `docs/images/walk.webp`.
"""

from __future__ import annotations

import tempfile
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from veduta.synthetic.walks.record import GorgeWalk, write_walk
from veduta.walk.build.film import frame_at
from veduta.walk.build.local_model import build_local_model
from veduta.walk.build.way import find_way
from veduta.walk.options import TakeOptions
from veduta.walk.read.pairs import read_stereo
from veduta.walk.record import read_stereo_record

PICTURE = Path(__file__).parent / "images" / "walk.webp"
FRAMES, MS = 14, 80
"""Of each transition, and how long each is shown."""


def main() -> None:
    """Shoot, walk, and write the frames."""
    frames: list[NDArray[np.uint8]] = []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        write_walk(folder, GorgeWalk(keys=4, step_m=3.0, width_px=480, height_px=270, pool=True))
        record = read_stereo_record(folder, TakeOptions(), None)
        rig = record.rectifier.rig
        models = [
            build_local_model(read_stereo(views[0], record.rectifier), rig) for views in record.keys
        ]
    for first, second in zip(models, models[1:], strict=False):
        way = find_way(first, second, rig)
        for number in range(FRAMES):
            ends = [(one.image, one.screen) for one in (first, second)]
            frames.append(frame_at(way, ends[0], ends[1], first.screen, number / FRAMES))
    pictures = [Image.fromarray(frame) for frame in [*frames, *frames[::-1]]]
    pictures[0].save(
        PICTURE, save_all=True, append_images=pictures[1:], duration=MS, loop=0, quality=55
    )


if __name__ == "__main__":
    main()
