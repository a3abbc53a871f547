"""An animal that goes along a path, in a place of its own."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from veduta.fauna.document.load import DOCUMENT
from veduta.fauna.motion.angles import Floats
from veduta.fauna.motion.transfer import Walker
from veduta.place.manifest import AnimalClip, PlaceAnimal, Start
from veduta.place.mesh import Mesh
from veduta.place.place import Place, Standing

ROOT = "root"


@dataclass(frozen=True, eq=False)
class Goer:
    """What goes: a mesh with a skeleton and clips, the usual one first. walker: how it goes along a
    path; None where its clips do not go on.
    """

    name: str
    mesh: Mesh
    length_m: float
    swims: bool
    clips: tuple[AnimalClip, ...]
    walker: Walker | None = None

    def standing(self) -> Standing:
        """How it stands in a place."""
        return Standing(name=self.name, document=DOCUMENT, arrangement="invented")

    def along(
        self, path: Floats, *, closed: bool, corners: tuple[int, ...] = ()
    ) -> PlaceAnimal:
        """How it goes along a path (n, 3) m, for the place's manifest; it turns on the spot at the
        rows `corners`.
        """
        return PlaceAnimal(
            id=self.name, name=self.name, part=self.mesh.id, root=ROOT, length=self.length_m,
            swims=self.swims, clips=list(self.clips), path=path.tolist(), closed=closed,
            turns=list(corners) if self.walker is not None and self.walker.legs else None,
        )  # fmt: skip


def place_of(goer: Goer, path: Floats | None = None) -> Place:
    """The animal in a place of its own. path: (n, 3) on the ground; else a round about the origin."""
    place = Place(title=goer.name)
    place.add(goer.mesh, goer.standing())
    closed = path is None
    line = round_path(goer.length_m) if path is None else path
    place.animals.append(goer.along(line, closed=closed))
    place.start = first_view(line, goer.length_m)
    return place


def first_view(path: Floats, length_m: float) -> Start:
    """Where a visitor begins: beside the animal, near enough to see it, however long its path is.

    It stands half its length into the path, and soon goes on: the look is a little ahead.
    """
    arcs = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(path, axis=0), axis=1))])
    here, ahead = (
        np.array([np.interp(way * length_m, arcs, path[:, axis]) for axis in range(3)])
        for way in (0.5, 1.5)
    )
    along = ahead[:2] - here[:2]
    along = along / max(float(np.linalg.norm(along)), 1e-9)
    aside = np.array([along[1], -along[0], 0.0])
    onward = np.array([along[0], along[1], 0.0])
    target = here + length_m * np.array([0.0, 0.0, 0.3]) + 0.6 * length_m * onward
    eye = target + length_m * (2.6 * aside + 1.5 * onward + np.array([0.0, 0.0, 1.3]))
    return Start(eye=_vector(eye), target=_vector(target))


def round_path(length_m: float) -> Floats:
    """A round with a waist, wide enough for the body's length: (n, 3), first and last the same."""
    turn = np.linspace(0.0, 2.0 * np.pi, 65)
    radius = length_m * (1.25 + 0.3 * np.cos(2.0 * turn))
    around = np.stack([radius * np.cos(turn), radius * np.sin(turn), np.zeros_like(turn)], axis=1)
    around[-1] = around[0]
    return np.asarray(around)


def _vector(values: Floats) -> tuple[float, float, float]:
    x, y, z = (float(value) for value in values)
    return (x, y, z)
