"""What textures are compared with: one colour per face, and the best view as it is."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

import numpy as np

from veduta.photos.city.model import CityModel
from veduta.photos.options import TextureOptions
from veduta.photos.texture.cells import Sights, sights_of
from veduta.photos.texture.choice import Choice
from veduta.photos.texture.compose import FaceTexture, compose
from veduta.photos.texture.part import TexturedBuilding, textured_building
from veduta.photos.texture.plan import plan_of
from veduta.photos.texture.recipe import texture_model
from veduta.photos.texture.sizes import fine_m, texel_sizes
from veduta.photos.texture.store import PictureStore
from veduta.photos.texture.views import Blockers, View
from veduta.place.part import Part


def ours(views: Sequence[View], city: CityModel, options: TextureOptions) -> list[Part]:
    """The verb's own."""
    return _parts(city, texture_model(views, city, options).buildings)


def best_view(views: Sequence[View], city: CityModel, options: TextureOptions) -> list[Part]:
    """Each cell from the photo that shows it finest, in the exposure of that photo."""
    gains = np.ones((len(views), 3))
    store = PictureStore(views, Blockers(city))

    def texture(sights: Sights, texel_m: float) -> FaceTexture:
        share = sights.share()
        usable = share > 0
        value = np.where(usable, sights.density * share, -1.0)
        label = value.argmax(axis=0)
        label[~usable.any(axis=0)] = -1
        choice = Choice(
            label, np.argsort(-value, axis=0, kind="stable"), usable, np.ones_like(sights.seen)
        )
        none = np.zeros((*label.shape, 3), dtype=np.float32)
        return compose(sights, choice, none, gains, store, texel_m)

    return _model(views, city, options, texture)


def median_colour(views: Sequence[View], city: CityModel, options: TextureOptions) -> list[Part]:
    """Each face in the median colour of all that photos show of it."""

    def texture(sights: Sights, texel_m: float) -> FaceTexture:
        colour = np.median(sights.colour[sights.seen], axis=0).astype(np.uint8)
        pixels = np.broadcast_to(colour, (4, 4, 3)).copy()
        side = max(sights.face.size_m) / 4
        return FaceTexture(pixels, np.zeros((4, 4), np.bool_), side, 1.0, ())

    return _model(views, city, options, texture)


def _model(
    views: Sequence[View],
    city: CityModel,
    options: TextureOptions,
    texture: Callable[[Sights, float], FaceTexture],
) -> list[Part]:
    blockers = Blockers(city)
    store = PictureStore(views, blockers)
    plan = plan_of(views, city, blockers, store)
    sights = sights_of(views, list(zip(plan.faces, plan.views, strict=True)), store)
    shown = [one for one in sights if one is not None]
    sizes = iter(texel_sizes([one.face for one in shown], [fine_m(one) for one in shown], options))
    textures = [None if one is None else texture(one, next(sizes)) for one in sights]
    made = [
        textured_building(
            row,
            building,
            [
                (face, one)
                for face, one in zip(plan.faces, textures, strict=True)
                if face.building == row
            ],
            options,
        )
        for row, building in enumerate(city.buildings)
    ]
    return _parts(city, made)


def _parts(city: CityModel, made: Iterable[TexturedBuilding]) -> list[Part]:
    """All buildings, those that photos do not show as they are."""
    textured = {building.row: building.part for building in made}
    return [textured.get(row, building.part) for row, building in enumerate(city.buildings)]
