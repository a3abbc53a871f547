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

    def along(self, path: Floats, *, closed: bool) -> PlaceAnimal:
        """How it goes along a path (n, 3) m, for the place's manifest."""
        return PlaceAnimal(
            id=self.name, name=self.name, part=self.mesh.id, root=ROOT, length=self.length_m,
            swims=self.swims, clips=list(self.clips), path=path.tolist(), closed=closed,
        )  # fmt: skip


def place_of(goer: Goer, path: Floats | None = None) -> Place:
    """The animal in a place of its own. path: (n, 3) on the ground; else a round about the origin."""
    place = Place(title=goer.name)
    place.add(goer.mesh, goer.standing())
    closed = path is None
    line = round_path(goer.length_m) if path is None else path
    place.animals.append(goer.along(line, closed=closed))
    size = float(np.ptp(line[:, :2], axis=0).max())
    middle = line.mean(axis=0)
    eye = middle + size * np.array([-0.35, -0.85, 0.6])
    place.start = Start(eye=_vector(eye), target=_vector(middle))
    return place


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
