"""The arguments of `veduta fauna`: the footage, the options, and how to run."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated

import tyro

from veduta.cli.run_arguments import Force, Out, Quiet
from veduta.fauna.options import AnimalOptions, FaunaOptions, FootageOptions, MotionOptions

Footage = Annotated[
    tyro.conf.Positional[Path],
    tyro.conf.arg(
        metavar="FOOTAGE",
        help_behavior_hint="",
        help=(
            "a video or a folder of frames; a CSV of midlines (frame, point, t, x, y); or an"
            " animal.json to build from again"
        ),
    ),
]


Masks = Annotated[
    Path | None,
    tyro.conf.arg(
        metavar="FOLDER",
        help_behavior_hint="",
        help="silhouettes of the animal, a picture for each frame, white where it is",
    ),
]
BackgroundPicture = Annotated[
    Path | None,
    tyro.conf.arg(
        metavar="PICTURE",
        help_behavior_hint="",
        help="what the camera sees without the animal; else it is estimated from the frames",
    ),
]

InPlace = Annotated[
    Path | None,
    tyro.conf.arg(
        metavar="FOLDER",
        help_behavior_hint="",
        help="a place that Veduta wrote, into which the animal is put: OUT has both",
    ),
]
Way = Annotated[
    Path | None,
    tyro.conf.arg(
        metavar="FILE",
        help_behavior_hint="",
        help=(
            "GeoJSON of the points through which it goes, in metres of the place; else it goes"
            " round where it has room"
        ),
    ),
]

OwnPlan = Annotated[
    Path | None,
    tyro.conf.arg(
        metavar="TOML",
        help_behavior_hint="",
        help="a body plan of your own: parts, joints, sides, which touch the ground",
    ),
]

Joints = Annotated[
    Path | None,
    tyro.conf.arg(
        metavar="FILE",
        help_behavior_hint="",
        help=(
            "where the joints of an animal with legs are: a CSV as DeepLabCut writes it, or a JSON"
            " as BADJA has it; gaps may be"
        ),
    ),
]
Markers = Annotated[
    Path | None,
    tyro.conf.arg(
        metavar="TOML",
        help_behavior_hint="",
        help="markers that are painted on the joints of an animal with legs, by their colours",
    ),
]

Gaits = Annotated[
    Path | None,
    tyro.conf.arg(
        metavar="FILE",
        help_behavior_hint="",
        help="animal.json of another animal with legs, or of other footage: its gaits are taken on",
    ),
]


SecondView = Annotated[
    Path | None,
    tyro.conf.arg(
        metavar="PATH",
        help_behavior_hint="",
        help=(
            "the animal from the other side (a silhouette, a folder of some, or footage): how high"
            " one is that was seen from above, how wide one that was seen from the side"
        ),
    ),
]


@dataclass(frozen=True)
class FaunaCall:
    """Turn footage of an animal into a moving 3D animal.

    The animal is in OUT/animal.glb with its skeleton and clips, what was found of it in
    OUT/animal.json, and OUT/place.json has it on a path, for `veduta view`.

    Exit codes: 0 done, 2 bad use or input, 3 there is no animal in the footage, 1 a bug.
    """

    footage: Footage
    out: Out
    animal: AnimalOptions = field(default_factory=AnimalOptions)
    reading: FootageOptions = field(default_factory=FootageOptions)
    masks: Masks = None
    background: BackgroundPicture = None
    place: InPlace = None
    path: Way = None
    plan: OwnPlan = None
    joints: Joints = None
    markers: Markers = None
    gaits: Gaits = None
    second_view: SecondView = None
    motion: MotionOptions = field(default_factory=MotionOptions)
    force: Force = False
    quiet: Quiet = False

    def options(self) -> FaunaOptions:
        """What changes the result."""
        return FaunaOptions(animal=self.animal, footage=self.reading, motion=self.motion)
