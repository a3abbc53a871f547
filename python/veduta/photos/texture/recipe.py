"""The coarse model's faces textured from the photos: from views and a city model to parts.

The recipe: which faces photos show; by lots of faces, what each photo sees of each face, the views
laid onto each other, how bright the photos are to each other, what stands before the walls; then
face by face which photo shows each cell, the offsets over the seams, the texture, and building by
building the atlases. A lot at a time is in memory, and a building's textures.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import closing
from dataclasses import dataclass
from itertools import groupby

import numpy as np
from numpy.typing import NDArray

from veduta.photos.city.model import CityModel
from veduta.photos.options import TextureOptions
from veduta.photos.texture.align import aligned
from veduta.photos.texture.cells import Sights, sights_of
from veduta.photos.texture.choice import cell_colours, choose, signal, undisturbed
from veduta.photos.texture.compose import FaceTexture, compose
from veduta.photos.texture.faces import Face
from veduta.photos.texture.levels import LightSamples
from veduta.photos.texture.part import TexturedBuilding, textured_building
from veduta.photos.texture.plan import Plan, lots_of, plan_of
from veduta.photos.texture.seams import offsets_of
from veduta.photos.texture.sizes import fine_m, texel_sizes
from veduta.photos.texture.spool import Spool
from veduta.photos.texture.store import COARSE_PX, PictureStore
from veduta.photos.texture.views import Blockers, View
from veduta.run.errors import NotFoundError
from veduta.run.progress import StepProgress, no_progress


@dataclass(frozen=True)
class TexturedModel:
    """A city model with textures; `city` is what it was made of.

    buildings: those that photos show anything of, each made when it is asked for, once; neighbours
    beside each other. gains: (photos, 3) what the linear light of each photo was multiplied with.
    """

    city: CityModel
    buildings: Iterator[TexturedBuilding]
    gains: NDArray[np.float64]


@dataclass(frozen=True)
class _Lots:
    """What photos show of faces, by lots. shown: of each lot, which faces (rows) it has."""

    spool: Spool
    shown: list[list[int]]

    def __len__(self) -> int:
        return len(self.shown)

    def change(self, made: Callable[[Sights], Sights]) -> None:
        """Put another in the place of each."""
        for lot in range(len(self)):
            self.spool.put(lot, [made(one) for one in self.spool.get(lot)])

    def __iter__(self) -> Iterator[tuple[int, Sights]]:
        """Each with the row of its face."""
        for lot, rows in enumerate(self.shown):
            yield from zip(rows, self.spool.get(lot), strict=True)


def texture_model(
    views: Sequence[View],
    city: CityModel,
    options: TextureOptions,
    progress: StepProgress = no_progress,
) -> TexturedModel:
    """Texture the faces that the views show; NotFoundError where they show none of them."""
    blockers = Blockers(city)
    store = PictureStore(views, blockers, COARSE_PX)
    plan = plan_of(views, city, blockers, store, progress)
    lots = _seen(views, plan, store, progress)
    rows = [row for shown in lots.shown for row in shown]
    if not rows:
        lots.spool.close()
        raise NotFoundError(
            "textures",
            f"none of {len(views)} photos shows any of the model's {len(city.buildings)} buildings",
            "Look at the registration in report.html: do the photos lie where the buildings are?",
        )
    rough = _gains(len(views), lots, None)
    lots.change(lambda sights: aligned(sights, rough))
    gains = _gains(len(views), lots, _gains(len(views), lots, None))
    fine = [fine_m(sights) for _, sights in lots]
    sizes = texel_sizes([plan.faces[row] for row in rows], fine, options)
    texel_m = dict(zip(rows, sizes, strict=True))

    def textured(store: PictureStore) -> Iterator[tuple[int, FaceTexture]]:
        for row, sights in lots:
            yield row, _texture(sights, gains, store, texel_m[row])

    def buildings() -> Iterator[TexturedBuilding]:
        with closing(lots.spool):
            textures = textured(PictureStore(views, blockers))
            for building, own in _by_building(plan, textures, progress):
                yield textured_building(building, city.buildings[building], own, options)

    return TexturedModel(city, buildings(), gains)


def _seen(views: Sequence[View], plan: Plan, store: PictureStore, progress: StepProgress) -> _Lots:
    """What the views show of all faces."""
    lots = lots_of(plan)
    found = _Lots(Spool(), [])
    for number, rows in enumerate(lots):

        def told(share: float, number: int = number) -> None:
            progress("texture: what photos see", (number + share) / len(lots))

        sights = sights_of(views, [(plan.faces[row], plan.views[row]) for row in rows], store, told)
        kept = [(row, one) for row, one in zip(rows, sights, strict=True) if one is not None]
        found.shown.append([row for row, _ in kept])
        found.spool.put(number, [one for _, one in kept])
    return found


def _gains(photos: int, lots: _Lots, gains: NDArray[np.float64] | None) -> NDArray[np.float64]:
    """What makes the photos alike; by what they show undisturbed, where gains are known roughly."""
    samples = LightSamples(photos, sum(map(len, lots.shown)))
    for _, sights in lots:
        kept = None if gains is None else undisturbed(sights, signal(sights, gains))[0]
        samples.add(sights, kept)
    return samples.gains()


def _texture(
    sights: Sights,
    gains: NDArray[np.float64],
    store: PictureStore,
    texel_m: float,
) -> FaceTexture:
    levelled = signal(sights, gains)
    believed, distance = undisturbed(sights, levelled)
    choice = choose(sights, levelled, believed, distance, texel_m**-2)
    offsets = offsets_of(cell_colours(levelled, sights.share()), choice)
    return compose(sights, choice, offsets, gains, store, texel_m)


def _by_building(
    plan: Plan, textures: Iterator[tuple[int, FaceTexture]], progress: StepProgress
) -> Iterator[tuple[int, list[tuple[Face, FaceTexture | None]]]]:
    """All faces of each building that has any texture."""
    of_building = {
        building: list(own)
        for building, own in groupby(
            range(len(plan.faces)), key=lambda row: plan.faces[row].building
        )
    }
    for building, made in groupby(textures, key=lambda one: plan.faces[one[0]].building):
        known = dict(made)
        progress("texture: faces", of_building[building][-1] / len(plan.faces))
        yield building, [(plan.faces[row], known.get(row)) for row in of_building[building]]
