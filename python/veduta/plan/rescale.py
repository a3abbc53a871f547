"""A document with another scale: all that was measured on its drawings grows or shrinks with it."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np

from veduta.plan.document import PlanDocument, Point, Room, ScaleEvidence, Stairs, Storey
from veduta.plan.registering import registered
from veduta.plan.scale.estimate import GIVEN_SIGMA, judged_by

SAME = 1e-4
"""Scales that differ by less are the same."""


def rescaled(document: PlanDocument, mm_per_px: float | None) -> tuple[PlanDocument, list[str]]:
    """The document with a pixel of its drawings so large (mm, of the file), and what was done.

    Heights are on no plan and stay. Furniture and lamps are made anew: a sofa does not grow.
    """
    if mm_per_px is None:
        return document, []
    factors = [_factor(storey, mm_per_px) for storey in document.storeys]
    if all(abs(factor - 1.0) < SAME for factor in factors):
        return document, []
    storeys = [
        scaled(storey, factor) for storey, factor in zip(document.storeys, factors, strict=True)
    ]
    if max(factors) - min(factors) > SAME:
        storeys = registered(storeys)
    said = ", ".join(
        f"{storey.name} by {factor:.4g}"
        for storey, factor in zip(document.storeys, factors, strict=True)
    )
    note = f"--scale: {said}; furniture and lamps were made anew, heights stay"
    return document.model_copy(update={"storeys": storeys}), [note]


def _factor(storey: Storey, mm_per_px: float) -> float:
    linear = np.array(storey.sheet.clean_from_scan, dtype=np.float64)[:2, :2]
    finer = math.sqrt(abs(float(np.linalg.det(linear))))
    return mm_per_px / 1000.0 / finer / storey.sheet.metres_per_px


def scaled(storey: Storey, factor: float) -> Storey:
    """A storey times a factor, about the origin of the plan frame."""
    metres_per_px = storey.sheet.metres_per_px * factor
    given = ScaleEvidence(kind="given", metres_per_px=metres_per_px, sigma=GIVEN_SIGMA, agrees=True)
    written = [one for one in storey.scale.evidence if one.kind not in {"given", "assumed"}]
    scale = storey.scale.model_copy(
        update={
            "metres_per_px": metres_per_px,
            "sigma": GIVEN_SIGMA,
            "basis": "given",
            "evidence": [given, *judged_by(metres_per_px, written)],
        }
    )
    changes = {
        "sheet": storey.sheet.model_copy(update={"metres_per_px": metres_per_px}),
        "scale": scale,
        "junctions": [
            one.model_copy(update={"at_m": _at(one.at_m, factor)}) for one in storey.junctions
        ],
        "walls": [
            one.model_copy(update={"thickness_m": round(one.thickness_m * factor, 5)})
            for one in storey.walls
        ],
        "openings": [
            one.model_copy(
                update={
                    "along_m": round(one.along_m * factor, 5),
                    "width_m": round(one.width_m * factor, 5),
                }
            )
            for one in storey.openings
        ],
        "rooms": [_room(one, factor) for one in storey.rooms],
        "stairs": [_stairs(one, factor) for one in storey.stairs],
        "fittings": [
            one.model_copy(
                update={"at_m": _at(one.at_m, factor), "size_m": _at(one.size_m, factor)}
            )
            for one in storey.fittings
        ],
        "furniture": None,
        "lights": None,
    }
    return storey.model_copy(update=changes)


def _at(point: Point, factor: float) -> Point:
    return (round(point[0] * factor, 5), round(point[1] * factor, 5))


def _ring(points: Iterable[Point], factor: float) -> list[Point]:
    return [_at(point, factor) for point in points]


def _room(room: Room, factor: float) -> Room:
    return room.model_copy(
        update={
            "outline_m": _ring(room.outline_m, factor),
            "holes_m": [_ring(hole, factor) for hole in room.holes_m],
            "area_m2": round(room.area_m2 * factor**2, 4),
        }
    )


def _stairs(stairs: Stairs, factor: float) -> Stairs:
    return stairs.model_copy(
        update={
            "outline_m": _ring(stairs.outline_m, factor),
            "steps_m": [_ring(step, factor) for step in stairs.steps_m],
            "path_m": _ring(stairs.path_m, factor),
        }
    )
