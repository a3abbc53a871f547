"""What stands around a facade: pavement, road, and what may hide a part of it."""

from __future__ import annotations

from typing import Literal

import numpy as np

from veduta.synthetic.looks import Look
from veduta.synthetic.mesh import MeshBuilder
from veduta.synthetic.seeds import stream
from veduta.synthetic.textures import asphalt, foliage, paving, plain

Occluder = Literal["lamp", "tree", "car"]
OCCLUDERS: tuple[Occluder, ...] = ("lamp", "tree", "car")
PAVEMENT_M = 3.2
REACH_M = 90.0


def street_looks(seed: int) -> dict[str, Look]:
    """The materials of the street, by name."""
    rng = stream(seed, "street")
    body = tuple(
        rng.choice([[0.5, 0.06, 0.05], [0.1, 0.2, 0.4], [0.75, 0.76, 0.78], [0.08, 0.08, 0.09]])
    )
    glass = plain(rng, (0.06, 0.07, 0.08))
    paint = plain(rng, body, 0.0)
    return {
        "paving": Look(paving(rng), None, (2.4, 2.4)),
        "asphalt": Look(asphalt(rng), None, (4.0, 4.0)),
        "kerb": Look(plain(rng, (0.62, 0.61, 0.58), 0.06)),
        "pole": Look(plain(rng, (0.10, 0.13, 0.12))),
        "bark": Look(plain(rng, (0.26, 0.21, 0.16), 0.25)),
        "leaves": Look(foliage(rng)),
        "tyre": Look(plain(rng, (0.05, 0.05, 0.05))),
        "car paint": Look(paint, np.full(paint.shape[:2], 40, np.uint8)),
        "car glass": Look(glass, np.full(glass.shape[:2], 255, np.uint8)),
    }


def add_ground(builder: MeshBuilder, feature: int) -> None:
    """Pavement up to a kerb, the road in front of it, the far pavement, and land behind."""
    far = 2 * REACH_M
    builder.quad((-REACH_M, -PAVEMENT_M, 0), (far, 0, 0), (0, PAVEMENT_M, 0), "paving", feature)
    builder.quad((-REACH_M, -PAVEMENT_M, -0.13), (far, 0, 0), (0, 0, 0.13), "kerb", feature)
    builder.quad(
        (-REACH_M, -REACH_M, -0.13), (far, 0, 0), (0, REACH_M - PAVEMENT_M, 0), "asphalt", feature
    )
    builder.quad((-REACH_M, 0, -0.02), (far, 0, 0), (0, REACH_M, 0), "paving", feature)


def add_occluder(builder: MeshBuilder, kind: Occluder, x_m: float, seed: int, feature: int) -> None:
    """One object on the pavement or at the kerb, at `x_m` along the wall."""
    if kind == "lamp":
        _lamp(builder, x_m, feature)
    elif kind == "tree":
        _tree(builder, x_m, seed, feature)
    else:
        _car(builder, x_m, feature)


def _lamp(builder: MeshBuilder, x: float, feature: int) -> None:
    y = -PAVEMENT_M + 0.4
    builder.box((x - 0.11, y - 0.11, 0), (x + 0.11, y + 0.11, 0.9), "pole", feature)
    builder.box((x - 0.05, y - 0.05, 0.9), (x + 0.05, y + 0.05, 4.6), "pole", feature)
    builder.box((x - 0.2, y - 0.2, 4.6), (x + 0.2, y + 0.2, 5.2), "car glass", feature)
    builder.box((x - 0.24, y - 0.24, 5.2), (x + 0.24, y + 0.24, 5.3), "pole", feature)


def _tree(builder: MeshBuilder, x: float, seed: int, feature: int) -> None:
    rng = stream(seed, "tree")
    y = -PAVEMENT_M + 0.6
    builder.box((x - 0.13, y - 0.13, 0), (x + 0.13, y + 0.13, 3.4), "bark", feature)
    centre = np.array([x, y, 4.9])
    radius = np.array([1.3, 1.1, 1.9])
    for _ in range(1500):
        direction = rng.standard_normal(3)
        direction /= np.linalg.norm(direction)
        at = centre + direction * radius * rng.uniform(0.35, 1.0) ** 0.5
        u, v = rng.standard_normal(3), rng.standard_normal(3)
        u *= 0.11 / np.linalg.norm(u)
        v *= 0.11 / np.linalg.norm(v)
        box = tuple(rng.uniform(0, 1, 2)) * 2
        builder.quad(
            tuple(at),
            tuple(u),
            tuple(v),
            "leaves",
            feature,
            (box[0], box[1], box[0] + 0.1, box[1] + 0.1),
        )


def _car(builder: MeshBuilder, x: float, feature: int) -> None:
    """A parked car: a body, a cabin with slanted ends, wheels."""
    y0, y1 = -PAVEMENT_M - 2.0, -PAVEMENT_M - 0.25
    base = -0.13
    builder.box((x - 2.1, y0, base + 0.28), (x + 2.1, y1, base + 0.86), "car paint", feature)
    low, high = base + 0.86, base + 1.42
    for y, flip in ((y0 + 0.1, False), (y1 - 0.1, True)):
        corners = [
            np.array([x - 1.5, y, low]),
            np.array([x + 1.3, y, low]),
            np.array([x + 0.8, y, high]),
            np.array([x - 1.2, y, high]),
        ]
        if flip:
            corners = [corners[1], corners[0], corners[3], corners[2]]
        builder.face(corners, "car glass", feature)
    span = (0.0, y1 - y0 - 0.2, 0.0)
    builder.quad((x + 1.3, y0 + 0.1, low), span, (-0.5, 0, high - low), "car glass", feature)
    builder.quad(
        (x - 1.5, y1 - 0.1, low), (0.0, -span[1], 0.0), (0.3, 0, high - low), "car glass", feature
    )
    builder.quad((x - 1.2, y0 + 0.1, high), (2.0, 0, 0), span, "car paint", feature)
    for wheel in (x - 1.3, x + 1.3):
        centre = np.array([wheel, y0 - 0.01, base + 0.32])
        angle = np.linspace(0.0, 2 * np.pi, 13)
        rim = [centre + 0.32 * np.array([np.cos(t), 0, np.sin(t)]) for t in angle]
        for k in range(0, 12, 2):
            builder.face([centre, rim[k], rim[k + 1], rim[k + 2]], "tyre", feature)
