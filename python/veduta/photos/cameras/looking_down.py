"""Up of photos that look down: surveys from the air, whose rows are level all the same.

`orient` takes up from how people hold cameras. An aircraft looks down, and turns about the way that
it looks at the end of each line: the tops of its photos point to all sides, which those of photos
that people take standing never do. Then up is square to the ground, the plane that most points lie
about, to the side that the photos were taken from.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.photos.structure import Structure


@dataclass(frozen=True)
class SurveyParameters:
    """alike: least length of the mean of the ways that photos look. turned: most length of the
    mean of the ways that their columns run: people hold cameras upright, whose columns agree.
    rounds, cut: of the robust fit, in deviations.
    """

    alike: float = 0.75
    turned: float = 0.5
    rounds: int = 20
    cut: float = 2.5


def survey_up(
    structure: Structure, parameters: SurveyParameters | None = None
) -> NDArray[np.float64] | None:
    """(3,) up in the structure's frame; None where the photos were not taken so."""
    known = parameters or SurveyParameters()
    rotations = structure.cam_from_world[:, :, :3]
    ahead, down = rotations[:, 2].mean(axis=0), rotations[:, 1].mean(axis=0)
    if np.linalg.norm(ahead) < known.alike or np.linalg.norm(down) > known.turned:
        return None
    return ground_normal(structure, -ahead, known)


def ground_normal(
    structure: Structure, up: NDArray[np.float64], parameters: SurveyParameters
) -> NDArray[np.float64]:
    """(3,) of the plane that most points lie about, least absolute distances from a first up.

    Points are thinned, so that what has many features does not count more than bare ground.
    """
    points = _thinned(structure.points)
    normal = up / np.linalg.norm(up)
    basis = np.linalg.svd(normal[None])[2][1:]
    about = points - np.median(points, axis=0)
    flat, height = about @ basis.T, about @ normal
    columns = np.column_stack([flat, np.ones(len(flat))])
    weight = np.ones(len(flat))
    plane = np.zeros(3)
    for _ in range(parameters.rounds):
        weighted = columns * weight[:, None]
        plane = np.linalg.lstsq(weighted.T @ columns, weighted.T @ height, rcond=None)[0]
        left = height - columns @ plane
        spread = max(1.4826 * float(np.median(np.abs(left))), 1e-12)
        weight = np.clip(1.0 - (left / (parameters.cut * 1.9 * spread)) ** 2, 0.0, None) ** 2
    found = normal - plane[:2] @ basis
    unit: NDArray[np.float64] = found / np.linalg.norm(found)
    return unit


def _thinned(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """One point of each of some 5000 cells."""
    low, high = np.quantile(points, [0.02, 0.98], axis=0)
    inside = points[((points >= low) & (points <= high)).all(axis=1)]
    if len(inside) < 100:
        return points
    size = float(np.prod(np.sort(high - low)[1:])) / 5000.0
    cells = np.floor((inside - low) / max(np.sqrt(size), 1e-12)).astype(np.int64)
    _, first = np.unique(cells, axis=0, return_index=True)
    kept: NDArray[np.float64] = inside[np.sort(first)]
    return kept
