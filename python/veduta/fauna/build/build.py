"""The whole of an animal from its document: gaits, clips, mesh."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from veduta.fauna.build.body import body_mesh
from veduta.fauna.build.clips import spine_clip
from veduta.fauna.build.going import Goer
from veduta.fauna.build.skeleton import spine_of
from veduta.fauna.build.walker import limbless_walker
from veduta.fauna.document.schema import Animal
from veduta.fauna.motion.angles import Floats, angles_of
from veduta.fauna.motion.gaits import SAMPLES, Gait, roamed_gait, seen_gait, waved_gait
from veduta.fauna.motion.states import StateSampling
from veduta.fauna.motion.wave import FEWEST_CYCLES, Wave, swimming_wave
from veduta.fauna.options import MotionOptions
from veduta.place.manifest import AnimalClip
from veduta.place.material import Texture
from veduta.place.mesh import Mesh

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
    gaits += [roam]
    if motion.provenance in ("measured", "edited"):
        gaits += [seen_gait("footage", states, times, speed)]
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


def goer_of(animal: Animal, built: Built) -> Goer:
    """The animal as what goes through a place."""
    length = animal.length.metres
    clips = tuple(
        AnimalClip(
            name=gait.name, seconds=float(gait.times_s[-1]), stride=gait.stride * length,
            loops=gait.loops,
        )
        for gait in built.gaits
    )  # fmt: skip
    swims = animal.kind == "fish"
    walker = limbless_walker(built.mesh, clips[0].name, length, swims=swims)
    return Goer(animal.name, built.mesh, length, swims, clips, walker)
