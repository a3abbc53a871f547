"""The coarse model's faces textured from the photos: from views and a city model to parts.

The recipe: what each photo sees of each face, the views laid onto each other, how bright the photos
are to each other, what stands before the walls, which photo shows each cell, the offsets over the
seams, the texture, the atlases.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.photos.city.model import CityModel
from veduta.photos.options import TextureOptions
from veduta.photos.texture.align import aligned
from veduta.photos.texture.cells import Sights, sights_of
from veduta.photos.texture.choice import cell_colours, choose, signal, undisturbed
from veduta.photos.texture.compose import FaceTexture, compose
from veduta.photos.texture.faces import Face, faces_of
from veduta.photos.texture.levels import gains_of
from veduta.photos.texture.part import TexturedBuilding, textured_building
from veduta.photos.texture.seams import offsets_of
from veduta.photos.texture.sizes import texel_sizes
from veduta.photos.texture.store import PictureStore
from veduta.photos.texture.views import Blockers, View
from veduta.run.errors import NotFoundError
from veduta.run.progress import StepProgress, no_progress


@dataclass(frozen=True)
class TexturedModel:
    """A city model with textures; `city` is what it was made of.

    buildings: all of them, in the order of the city model. faces: what could be textured, and
    textures: the texture of each, None where no photo shows it. gains: (photos, 3) what the linear
    light of each photo was multiplied with.
    """

    city: CityModel
    buildings: tuple[TexturedBuilding, ...]
    faces: tuple[Face, ...]
    textures: tuple[FaceTexture | None, ...]
    gains: NDArray[np.float64]


def texture_model(
    views: Sequence[View],
    city: CityModel,
    options: TextureOptions,
    progress: StepProgress = no_progress,
) -> TexturedModel:
    """Texture the faces that the views show; NotFoundError where they show none of them."""
    faces = faces_of(city)
    sights = sights_of(views, city, faces, progress)
    shown = [one for one in sights if one is not None]
    if not shown:
        raise NotFoundError(
            "textures",
            f"none of {len(views)} photos shows any of the model's {len(faces)} faces",
            "Look at the registration in report.html: do the photos lie where the buildings are?",
        )
    rough = gains_of(len(views), shown)
    shown = [aligned(one, rough) for one in shown]
    gains, believed = _levelled(len(views), shown)
    store = PictureStore(views, Blockers(city))
    made = []
    for number, (sight, kept, texel_m) in enumerate(
        zip(shown, believed, texel_sizes(shown, options), strict=True)
    ):
        progress("texture: faces", number / len(shown))
        made.append(_texture(sight, kept, gains, views, store, texel_m))
    waiting = iter(made)
    textures = tuple(None if one is None else next(waiting) for one in sights)
    own: list[list[tuple[Face, FaceTexture | None]]] = [[] for _ in city.buildings]
    for face, texture in zip(faces, textures, strict=True):
        own[face.building].append((face, texture))
    buildings = []
    for row, building in enumerate(city.buildings):
        progress("texture: atlases", row / len(city.buildings))
        buildings.append(textured_building(building, own[row], options))
    return TexturedModel(city, tuple(buildings), tuple(faces), textures, gains)


def _levelled(
    photos: int, shown: Sequence[Sights]
) -> tuple[NDArray[np.float64], list[NDArray[np.bool_]]]:
    """The gains, and which views show each cell undisturbed: each helps to find the other."""
    gains = gains_of(photos, shown)
    believed = [undisturbed(sights, signal(sights, gains))[0] for sights in shown]
    gains = gains_of(photos, shown, believed)
    return gains, [undisturbed(sights, signal(sights, gains))[0] for sights in shown]


def _texture(
    sights: Sights,
    believed: NDArray[np.bool_],
    gains: NDArray[np.float64],
    views: Sequence[View],
    store: PictureStore,
    texel_m: float,
) -> FaceTexture:
    levelled = signal(sights, gains)
    distance = undisturbed(sights, levelled)[1]
    choice = choose(sights, levelled, believed, distance, texel_m**-2)
    offsets = offsets_of(cell_colours(levelled, sights.share()), choice)
    return compose(sights, choice, offsets, gains, views, store, texel_m)
