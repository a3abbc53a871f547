"""The whole of an animal from its document: gaits, clips, mesh, and a place in which it goes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from veduta.fauna.build.body import body_mesh
from veduta.fauna.build.clips import spine_clip
from veduta.fauna.build.skeleton import ROOT, spine_of
from veduta.fauna.document.load import DOCUMENT
from veduta.fauna.document.schema import Animal
from veduta.fauna.motion.angles import Floats, angles_of
from veduta.fauna.motion.gaits import SAMPLES, Gait, roamed_gait, seen_gait, waved_gait
from veduta.fauna.motion.states import StateSampling
from veduta.fauna.motion.wave import FEWEST_CYCLES, Wave, swimming_wave
from veduta.fauna.options import MotionOptions
from veduta.place.manifest import AnimalClip, PlaceAnimal, Start
from veduta.place.material import Texture
from veduta.place.mesh import Mesh
from veduta.place.place import Place, Standing

_WAVES = 0.5
"""A wave that explains less of the angles' variance than this is no gait of the animal."""
_WAVE_NAME = {"snake": "slither", "worm": "crawl", "fish": "swim"}


@dataclass(frozen=True, eq=False)
class Built:
    """The animal as a mesh with clips, its gaits (the usual one first), and the footage's wave."""

    mesh: Mesh
    gaits: tuple[Gait, ...]
    wave: Wave | None
    doubts: tuple[str, ...]


def build_animal(animal: Animal, options: MotionOptions, coat: Texture | None = None) -> Built:
    """All that follows from a document, edited or not, and from its coat."""
    motion = animal.motion
    states = motion.columns()
    times = np.array(motion.frame, dtype=np.float64) * motion.frame_s
    speed = options.speed or motion.speed
    wave, doubts = _wave(animal, angles_of(states, SAMPLES), times)
    sampling = StateSampling(count=options.states)
    roam = roamed_gait(
        "roam" if wave is not None else _WAVE_NAME[animal.kind], states, motion.frame_s, sampling,
        options.seed, options.seconds, speed, follows=animal.kind == "snake",
    )  # fmt: skip
    gaits = [] if wave is None else [waved_gait(_WAVE_NAME[animal.kind], wave, speed)]
    gaits += [roam, seen_gait("footage", states, times, speed)]
    spine = spine_of(animal)
    clips = tuple(spine_clip(gait, spine, animal.length.metres) for gait in gaits)
    return Built(body_mesh(animal, clips, coat), tuple(gaits), wave, tuple(doubts))


def _wave(animal: Animal, angles: Floats, times: Floats) -> tuple[Wave | None, list[str]]:
    """The footage's wave, where it swims or crawls by one; a snake on land follows its head."""
    if animal.kind == "snake":
        return None, []
    wave = swimming_wave(angles, times - times[0])
    if wave.share >= _WAVES and wave.cycles >= FEWEST_CYCLES:
        return wave, []
    reason = (
        f"no wave was found in the footage (the best explains {wave.share:.0%} of the angles, over"
        f" {wave.cycles:.1f} cycles): there is no clip of a single cycle"
    )
    return None, [reason]


def place_of(animal: Animal, built: Built, path: Floats | None = None) -> Place:
    """The animal in a place of its own. path: (n, 3) on the ground; else a round about the origin."""
    place = Place(title=animal.name)
    place.add(built.mesh, Standing(name=animal.name, document=DOCUMENT, arrangement="invented"))
    closed = path is None
    line = round_path(animal.length.metres) if path is None else path
    place.animals.append(going(animal, built, line, closed=closed))
    size = float(np.ptp(line[:, :2], axis=0).max())
    middle = line.mean(axis=0)
    eye = middle + size * np.array([-0.35, -0.85, 0.6])
    place.start = Start(eye=_vector(eye), target=_vector(middle))
    return place


def going(animal: Animal, built: Built, path: Floats, *, closed: bool) -> PlaceAnimal:
    """How the animal goes along a path, for the place's manifest."""
    length = animal.length.metres
    clips = [
        AnimalClip(
            name=gait.name, seconds=float(gait.times_s[-1]), stride=gait.stride * length,
            loops=gait.loops,
        )
        for gait in built.gaits
    ]  # fmt: skip
    return PlaceAnimal(
        id=animal.name, name=animal.name, part=built.mesh.id, root=ROOT, length=length,
        swims=animal.kind == "fish", clips=clips, path=path.tolist(), closed=closed,
    )  # fmt: skip


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
