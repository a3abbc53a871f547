"""One building on white paper: seen from the street, a little from the side, in slanting sun.

The light is that of a clear day; what the building stands on shows its shadow and nothing else.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from veduta.place.flatten import flattened
from veduta.place.material import Material
from veduta.place.part import NO_PARENT, Features, Part
from veduta.place.semantics import Provenance, SemanticClass
from veduta.synthetic.camera import Camera, look_at
from veduta.synthetic.light import daylight
from veduta.synthetic.render import measure, render
from veduta.synthetic.scene import RayScene

AZIMUTH_RAD, ELEVATION_RAD = np.radians(19.0), np.radians(7.0)
"""Where the eye stands: to the right of the front's normal, and above the level."""
SUN_AZIMUTH_RAD, SUN_ELEVATION_RAD = np.radians(-90.0 - 40.0), np.radians(40.0)
FOCAL = 3.2
"""Of the picture's larger side: a long lens, so that walls stay nearly parallel."""
MARGIN = 0.94
EXPOSURE = 0.98
SHADOW = 0.22
"""How much darker paper is in the shadow."""
PAPER = np.array([250, 249, 246], np.float32)
CLASS_COLOURS: Mapping[SemanticClass, str] = {
    SemanticClass.WALL: "#e9e2d3",
    SemanticClass.WINDOW: "#3d7cc2",
    SemanticClass.BALCONY: "#4c9a62",
    SemanticClass.CORNICE: "#e8bb36",
    SemanticClass.DOOR: "#c43d36",
    SemanticClass.SHOP: "#d9885a",
    SemanticClass.ROOF: "#8c97ad",
    SemanticClass.CHIMNEY: "#a8614f",
    SemanticClass.GROUND: "#b5b5a8",
    SemanticClass.OTHER: "#b9b2c0",
    SemanticClass.FLOOR: "#b08d67",
    SemanticClass.CEILING: "#e6e3dc",
    SemanticClass.FURNITURE: "#7f9a86",
    SemanticClass.SHADOW: "#5d5a63",
}
"""sRGB. Windows blue, balconies green, cornices yellow, doors red, as in the figure that
`sampling` names."""


def in_class_colours(part: Part) -> Part:
    """The part with a plain material for each class, and its instances as polygons."""
    part = flattened(part)
    classes = list(SemanticClass)
    materials = tuple(Material(one.value, _rgb(CLASS_COLOURS[one]), 0.9) for one in classes)
    of_polygon = part.features.class_code[part.polygon_feature].astype(np.int32)
    return replace(part, materials=materials, polygon_material=of_polygon)


def turned(part: Part, along: NDArray[np.float64]) -> Part:
    """The part with its instances as polygons, turned so that the direction `along` (2,) is x."""
    part = flattened(part)
    (x, y), length = along, float(np.hypot(*along))
    if y == 0 and x > 0:
        return part
    level = np.array([[x, y], [-y, x]]) / length
    points = part.positions_m.copy()
    points[:, :2] = part.positions_m[:, :2] @ level.T
    return replace(part, positions_m=points)


Box = tuple[NDArray[np.float64], NDArray[np.float64]]


def portrait(part: Part, box_m: Box, size_px: tuple[int, int], samples: int) -> NDArray[np.uint8]:
    """(h, w, 3) sRGB of a part whose front looks to -y; `samples` squared rays for a pixel.

    box_m: lower and upper corner of what the picture has room for: pictures with the same box and
    size have the same scale.
    """
    camera = _camera(box_m, size_px)
    scene = RayScene([(part, np.eye(4)), (_paper(part), np.eye(4))])
    light = daylight(0, True, SUN_AZIMUTH_RAD, SUN_ELEVATION_RAD)
    radiance = render(scene, camera, light, samples)
    ground, sky = _bare(scene, camera, samples, scene.first_feature[1])
    open_ground = radiance[ground > 0.99].mean(axis=1)
    lit = float(np.percentile(open_ground, 60)) if len(open_ground) else 1.0
    level = np.clip(radiance.mean(axis=2) / max(0.97 * lit, 1e-6), 0.0, 1.0)
    shade = np.where(sky > 0, 1.0, 1.0 - SHADOW * (1.0 - level) * _fading(size_px))[..., None]
    bare = (ground + sky)[..., None]
    picture = _encoded(radiance * np.float32(EXPOSURE))
    return np.asarray(np.rint(picture * (1 - bare) + PAPER * shade * bare), np.uint8)


def _camera(box_m: Box, size_px: tuple[int, int]) -> Camera:
    """A camera that has the whole box in the picture, as large as it goes."""
    low, high = box_m
    centre = (low + high) / 2
    away = np.array(
        [
            np.sin(AZIMUTH_RAD) * np.cos(ELEVATION_RAD),
            -np.cos(AZIMUTH_RAD) * np.cos(ELEVATION_RAD),
            np.sin(ELEVATION_RAD),
        ]
    )
    focal = FOCAL * max(size_px)
    corners = np.array(np.meshgrid(*zip(low, high, strict=True))).reshape(3, -1).T
    distance = float(np.linalg.norm(high - low)) * 4
    for _ in range(5):
        camera = _level_camera(centre + distance * away, centre, size_px, focal)
        pixels, _ = camera.project(corners)
        share = np.ptp(pixels, axis=0) / np.array(size_px)
        distance *= float(share.max()) / MARGIN
    offset = np.array(size_px) / 2 - (pixels.min(axis=0) + pixels.max(axis=0)) / 2
    x, y = camera.centre_px
    return replace(camera, centre_px=(x + float(offset[0]), y + float(offset[1])))


def _level_camera(
    eye: NDArray[np.float64], target: NDArray[np.float64], size_px: tuple[int, int], focal_px: float
) -> Camera:
    """A camera that looks level, as architects' do: what is upright stays upright."""
    level = np.array([target[0], target[1], eye[2]])
    return look_at(_triple(eye), _triple(level), size_px, focal_px)


def _fading(size_px: tuple[int, int]) -> NDArray[np.float64]:
    """(h, w) 1 in the middle, 0 at the left and right edge: shadows end before pictures do."""
    x = (np.arange(size_px[0]) + 0.5) / size_px[0]
    ramp = np.clip(np.minimum(x, 1 - x) / 0.14, 0.0, 1.0)
    return np.broadcast_to(ramp * ramp * (3 - 2 * ramp), (size_px[1], size_px[0]))


def _bare(
    scene: RayScene, camera: Camera, samples: int, paper_feature: int
) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """(h, w) each: how much of a pixel is bare ground, and how much is sky.

    They are asked at the places that the picture is taken of.
    """
    steps = [(i + 0.5) / samples - 0.5 for i in range(samples)]
    ground = np.zeros((camera.height_px, camera.width_px), np.float32)
    sky = np.zeros_like(ground)
    for dx in steps:
        for dy in steps:
            x, y = camera.centre_px
            feature = measure(scene, replace(camera, centre_px=(x - dx, y - dy))).feature
            ground += feature == paper_feature
            sky += feature < 0
    count = np.float32(samples * samples)
    return ground / count, sky / count


def _paper(part: Part) -> Part:
    """What the building stands on."""
    low, high = (np.array(corner) for corner in part.bounds_m)
    reach = 60.0 * float(np.linalg.norm(high - low))
    (x0, y0, z), (x1, y1, _) = low - reach, high + reach
    z = float(low[2]) - 0.01
    corners = np.array([[x0, y0, z], [x1, y0, z], [x1, y1, z], [x0, y1, z]], np.float32)
    features = Features(
        id=("paper",),
        name=("paper",),
        class_code=np.array([SemanticClass.GROUND.code], np.uint8),
        provenance_code=np.array([Provenance.INVENTED.code], np.uint8),
        parent=np.array([NO_PARENT], np.int32),
        shell=np.zeros(1, np.int32),
        width_m=np.full(1, np.nan),
        height_m=np.full(1, np.nan),
        photo_px=np.full((1, 4), np.nan),
        seen_height_m=np.full(1, np.nan),
        score=np.full(1, np.nan),
    )
    return Part(
        id="paper",
        positions_m=corners,
        uv=np.zeros((4, 2), np.float32),
        ring_offsets=np.array([0, 4], np.int64),
        polygon_offsets=np.array([0, 1], np.int64),
        polygon_feature=np.zeros(1, np.int32),
        polygon_material=np.zeros(1, np.int32),
        features=features,
        materials=(Material("paper", (0.9, 0.9, 0.9), 0.9),),
    )


def _encoded(light: NDArray[np.float32]) -> NDArray[np.float32]:
    """Linear light as sRGB values 0 to 255; what is brighter than white bends towards it."""
    shoulder = 0.75
    over = np.maximum(light - shoulder, 0.0)
    bent = np.minimum(light, shoulder) + (1 - shoulder) * over / (over + (1 - shoulder))
    low, high = 12.92 * bent, 1.055 * np.maximum(bent, 1e-6) ** (1 / 2.4) - 0.055
    return np.asarray(255.0 * np.where(bent <= 0.0031308, low, high), np.float32)


def _rgb(text: str) -> tuple[float, float, float]:
    red, green, blue = (int(text[at : at + 2], 16) / 255 for at in (1, 3, 5))
    return red, green, blue


def _triple(point: NDArray[np.float64]) -> tuple[float, float, float]:
    x, y, z = point.tolist()
    return x, y, z
