"""Which photos are compared with which.

All pairs of n photos are n (n - 1) / 2, half a second each: beyond some dozens only neighbours are
compared: by GPS where the photos have it, else in the order in which they were taken where that is
known, else those that look most alike (`retrieval`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from datetime import datetime
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

from veduta.photos.intake.read import PhotoRecord
from veduta.photos.matching.retrieval import look_alikes
from veduta.photos.options import MatchOptions, Pairing
from veduta.run.errors import InputError

FEW = 60
"""Photos of which all pairs are compared."""
ENOUGH_GPS = 0.8
"""Share of the photos that must have a position before neighbours are chosen by it."""
EARTH_RADIUS_M = 6_371_000.0
LEAST_PANORAMAS = 2
"""Panoramas that each is compared with, on each side of an order or by place: all views of one look
to all sides, so neighbours are counted in whole panoramas."""


@dataclass(frozen=True)
class Pairs:
    """pairs: image ids, the smaller first, without repeats. how: for the report."""

    pairs: tuple[tuple[int, int], ...]
    kind: Pairing
    how: str


def choose_pairs(photos: Sequence[PhotoRecord], options: MatchOptions) -> Pairs:
    """The pairs to compare; InputError where GPS is asked for and there is none.

    Those that look alike are not known before there are features: `retrieved_pairs`.
    """
    kind = options.pairs if options.pairs != "auto" else _kind(photos)
    if kind == "all":
        ids = [photo.image_id for photo in photos]
        every = [(a, b) for row, a in enumerate(ids) for b in ids[row + 1 :]]
        return _seen_apart(Pairs(tuple(every), kind, "all pairs"), photos)
    if kind == "sequence":
        return _seen_apart(_sequence(photos, options.neighbours), photos)
    if kind == "retrieval":
        how = f"the {options.neighbours} that look most alike"
        if options.pairs == "auto":
            how += ", for most photos have no position and not all have a time"
        return Pairs((), kind, how)
    return _seen_apart(_nearest(photos, options.neighbours), photos)


def _seen_apart(chosen: Pairs, photos: Sequence[PhotoRecord]) -> Pairs:
    """The same without pairs of views of one panorama: how they lie to each other is known."""
    whole = {photo.image_id: photo.view.panorama for photo in photos if photo.view is not None}
    kept = [
        pair
        for pair in chosen.pairs
        if pair[0] not in whole or whole[pair[0]] != whole.get(pair[1])
    ]
    return replace(chosen, pairs=tuple(kept))


def _views(photos: Sequence[PhotoRecord]) -> int:
    """Of a panorama; 0 where there are none."""
    views = {photo.view.number for photo in photos if photo.view is not None}
    return len(views)


def _kind(photos: Sequence[PhotoRecord]) -> Pairing:
    if len(photos) <= FEW:
        return "all"
    placed = sum(photo.position is not None for photo in photos)
    if placed >= ENOUGH_GPS * len(photos):
        return "gps"
    return "sequence" if all(photo.time is not None for photo in photos) else "retrieval"


def retrieved_pairs(
    chosen: Pairs,
    photos: Sequence[PhotoRecord],
    features: Sequence[Path],
    options: MatchOptions,
    seed: int,
) -> Pairs:
    """The same choice with its pairs; features: the file of each photo's."""
    ids = [photo.image_id for photo in photos]
    found = look_alikes(features, options.neighbours, seed)
    pairs = sorted(_pair(ids[first], ids[second]) for first, second in found)
    return _seen_apart(replace(chosen, pairs=tuple(pairs)), photos)


def _sequence(photos: Sequence[PhotoRecord], reach: int) -> Pairs:
    """Each photo with the next ones, and with some far ahead, so that loops can close."""
    timed = all(photo.time is not None for photo in photos)
    order = sorted(photos, key=lambda photo: (photo.time or datetime.min, _name(photo)))
    mounts = {
        photo.mount.camera for photo in photos if photo.mount is not None and photo.view is None
    }
    views = _views(photos)
    if views:
        reach = (len(mounts) + views) * max(LEAST_PANORAMAS, -(-reach // views))
    else:
        reach *= max(1, len(mounts))  # neighbours are frames
    ids = [photo.image_id for photo in order]
    steps = sorted({*range(1, reach + 1), *_doublings(reach, len(ids))})
    pairs = {_pair(a, b) for step in steps for a, b in zip(ids, ids[step:], strict=False)}
    by = "time" if timed else "name"
    return Pairs(
        tuple(sorted(pairs)), "sequence", f"{reach} neighbours on each side in the order of {by}"
    )


def _name(photo: PhotoRecord) -> tuple[str, str]:
    """What orders photos without times; the cameras of a rig by their frames."""
    return (photo.name, "") if photo.mount is None else (photo.mount.frame, photo.mount.camera)


def _doublings(reach: int, count: int) -> list[int]:
    steps = []
    step = 2 * reach
    while step < count:
        steps.append(step)
        step *= 2
    return steps


def _nearest(photos: Sequence[PhotoRecord], count: int) -> Pairs:
    """Each photo with those nearest by GPS; those without a position by their order."""
    placed = [photo for photo in photos if photo.position is not None]
    if len(placed) < 2:
        raise InputError(
            "--pairs gps",
            f"{len(placed)} of {len(photos)} photos say where they were taken",
            "Choose all or sequence.",
        )
    degrees = np.array(
        [
            (photo.position.latitude_deg, photo.position.longitude_deg)
            for photo in placed
            if photo.position is not None
        ]
    )
    radians = np.deg2rad(degrees)
    level = np.cos(radians[:, 0].mean())
    metres = EARTH_RADIUS_M * np.column_stack([radians[:, 1] * level, radians[:, 0]])
    told, views = count, _views(placed)
    if views:  # those of its own panorama are the nearest of each, and are not compared with it
        count = views * (max(2 * LEAST_PANORAMAS, -(-count // views)) + 1) - 1
    nearest = cKDTree(metres).query(metres, k=min(count + 1, len(placed)))[1]
    pairs = {
        _pair(placed[row].image_id, placed[other].image_id)
        for row, others in enumerate(np.asarray(nearest).tolist())
        for other in others
        if other != row
    }
    rest = len(photos) - len(placed)
    how = f"the {told} nearest by GPS" + (", counted in panoramas" if views else "")
    if rest:
        pairs |= set(_sequence(photos, min(told, 5)).pairs)
        how += f", and neighbours in order because of {rest} photos without a position"
    return Pairs(tuple(sorted(pairs)), "gps", how)


def _pair(first: int, second: int) -> tuple[int, int]:
    return (first, second) if first < second else (second, first)
