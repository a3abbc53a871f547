"""Options that can have no effect in a call: refused, for who gives one counts on it.

An option counts as given where it is not what it is by default.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from veduta.photos.intake.given import Given
from veduta.photos.options import PhotosOptions
from veduta.run.errors import InputError
from veduta.run.options import Options, flag


@dataclass(frozen=True)
class _Idle:
    """Options that have no effect, and why. group: of `PhotosOptions`; no fields are all of it."""

    group: str
    fault: str
    remedy: str
    fields: tuple[str, ...] = ()


def require_effect(options: PhotosOptions, given: Given) -> None:
    """InputError for the first option that changes nothing beside the others; it names both."""
    for idle in _idle(options, given):
        for name in _given(getattr(options, idle.group), idle.fields):
            raise InputError(flag(name), idle.fault, idle.remedy)


def _given(group: Options, fields: tuple[str, ...]) -> list[str]:
    """The fields whose value is not the default."""
    declared = type(group).model_fields
    return [name for name in fields or declared if getattr(group, name) != declared[name].default]


def _idle(options: PhotosOptions, given: Given) -> Iterator[_Idle]:
    if given.from_colmap is not None:
        fault = "has no effect with --from-colmap: nothing is matched, mapped or adjusted there"
        for group in ("match", "map", "camera"):
            yield _Idle(group, fault, "Leave it out, or --from-colmap.")
    if given.video is None:
        fault = "is about the frames of a film, and there is no --video"
        yield _Idle("video", fault, "Name a film with --video, or leave it out.")
    if options.camera.rig:
        fault = "has no use with --rig: {}"
        shared = fault.format("all photos of a folder are of one camera")
        yield _Idle("camera", shared, "Leave one of the two out.", ("cameras",))
        one = fault.format("it is of one camera, and a rig has several")
        yield _Idle("camera", one, "Leave one of the two out.", ("focal_px",))
        once = fault.format("its poses are found from a map that grew photo by photo")
        yield _Idle("map", once, "Leave one of the two out.", ("mapping",))
    if options.match.pairs == "all":
        fault = "has no effect with --pairs all, which compares each photo with every other"
        yield _Idle("match", fault, "Leave one of the two out.", ("neighbours",))
    if options.walls.no_walls:
        fault = "is about walls, and --no-walls looks for none"
        yield _Idle("walls", fault, "Leave one of the two out.", ("wall_points", "wall_side_px"))
    yield from _idle_of_world(options)


def _idle_of_world(options: PhotosOptions) -> Iterator[_Idle]:
    """Those of control points, the city model and its textures."""
    world, method = options.world, f"--georef {options.world.georef}"
    if world.georef in ("gps", "model", "off"):
        fault = f"has no effect with {method}, which does not use control points"
        yield _Idle("world", fault, f"Leave it out, or {method}.", ("gcp",))
    if world.model is None:
        fault = "is about a city model, and there is no --model"
        remedy = "Give --model, too, or leave it out."
        of_model = ("crs", "model_up", "height_attribute", "layer")
        yield _Idle("world", fault, remedy, of_model)
        yield _Idle("texture", fault, remedy)
    if world.georef == "off":
        fault = f"has no effect with {method}, which lays the photos into nothing"
        yield _Idle("world", fault, f"Leave it out, or {method}.", ("model",))
    if options.texture.no_texture:
        fault = "is about textures, and --no-texture makes none"
        yield _Idle("texture", fault, "Leave one of the two out.", ("texel_m", "max_atlas_px"))
