"""The model of an animal with limbs from its document, and what `veduta fauna` tells of it."""

from __future__ import annotations

from veduta.fauna.build.going import Goer
from veduta.fauna.build.limbed import BuiltLimbed, build_limbed
from veduta.fauna.build.walker import limbed_walker
from veduta.fauna.document.limbed import LimbedAnimal
from veduta.fauna.options import FaunaOptions
from veduta.place.material import Texture
from veduta.run.page import Table
from veduta.run.work import Work


def make_limbed(
    work: Work, animal: LimbedAnimal, coat: Texture | None, options: FaunaOptions
) -> Goer:
    """The model; its clips and doubts are told."""
    with work.step("motion") as step:
        built = build_limbed(animal, coat, options.motion.speed)
        step.counts["clips"] = len(built.clips)
    _tell(work, animal, built)
    length = animal.length.metres
    return Goer(animal.name, built.mesh, length, False, built.clips, limbed_walker(built))


def _tell(work: Work, animal: LimbedAnimal, built: BuiltLimbed) -> None:
    for doubt in (*animal.doubts, *built.doubts):
        work.doubt(doubt)
    if animal.widths == "measured":
        work.note(
            "by the second view its body is"
            f" {animal.plan.parts[0].round:.2g} times as wide as it is thick in the first"
        )
    if animal.missing:
        work.note(f"the silhouettes show no {', '.join(animal.missing)}")
    slides = {stride.name: stride.slides for stride in built.strides}
    work.table(
        Table(
            "Clips",
            ("clip", "seconds", "way (m)", "loops", "a standing foot slides (lengths)"),
            [
                (clip.name, clip.seconds, clip.stride, "yes" if clip.loops else "no",
                 slides.get(clip.name))
                for clip in built.clips
            ],
        )
    )  # fmt: skip
    if animal.gaits:
        work.table(
            Table(
                "Gaits",
                ("gait", "foot", "comes down", "goes up", "stands for"),
                [
                    (gait.name, step.limb, step.down, step.up, (step.up - step.down) % 1.0)
                    for gait in animal.gaits
                    for step in gait.feet
                ],
            )
        )
    work.measure("length_m", animal.length.metres)
    work.measure("frames_used", animal.source.used)
    work.fact("length", f"{animal.length.metres:.3g} m ({animal.length.provenance})")
    work.fact("frames", f"{animal.source.used} of {animal.source.frames}")
    names = ", ".join(clip.name for clip in built.clips)
    work.fact("clips", names)
    work.summary = (
        f"A {animal.kind} of {animal.length.metres:.3g} m from {animal.source.used} of"
        f" {animal.source.frames} frames, with the clips {names}"
    )
