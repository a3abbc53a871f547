"""Whether a transition is good: each end's model must predict what is seen from the other end."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.walk.build.mesh import MorphMesh
from veduta.walk.build.morph import inverse
from veduta.walk.build.render import Layer, Mixing, draw_mesh
from veduta.walk.build.screen import Screen
from veduta.walk.rig import Image

Matrix = NDArray[np.float64]
_PEAK = 255.0


@dataclass(frozen=True)
class JudgeLimits:
    """gain_db: least gain over the unmoved picture. covered: least share of the other view that the
    model covers. psi: least share of the picture that has a counterpart.
    """

    gain_db: float = 0.7
    covered: float = 0.15
    psi: float = 0.03


@dataclass(frozen=True)
class Verdict:
    """score_db: PSNR of the prediction where it is; unmoved_db: of the picture as it is, there.

    covered: share of the other view that is predicted. why: what is wrong; empty: nothing.
    """

    score_db: float
    unmoved_db: float
    covered: float
    psi: float
    why: str = ""


def judge(
    mesh: MorphMesh, second_from_first: Matrix, screens: tuple[Screen, Screen], first: Image,
    second: Image, psi: float, limits: JudgeLimits = JudgeLimits(),
) -> tuple[Verdict, Image]:  # fmt: skip
    """Predict the second view from the first picture's colours alone; also the prediction.

    screens: of both. Mosaics differ in size by a row or two: the unmoved picture is laid upon the
    second one's rays.
    """
    screen = screens[1]
    own = _own_colours(mesh, second_from_first, screen, first)
    seen = own.weight > 0.5
    covered = float(seen.mean())
    predicted = np.clip(np.round(own.colour), 0, 255).astype(np.uint8)
    score = psnr(predicted[seen], second[seen]) if covered > 0.0 else 0.0
    unmoved = psnr(laid_over(first, *screens)[seen], second[seen]) if covered > 0.0 else 0.0
    why = ""
    if covered < limits.covered:
        why = f"the model covers {covered:.0%} of the next view"
    elif psi < limits.psi:
        why = f"{psi:.0%} of the view has a counterpart in the next one"
    elif score - unmoved < limits.gain_db:
        why = (
            f"the next view is predicted at {score:.1f} dB, and the unmoved picture comes to"
            f" {unmoved:.1f} dB"
        )
    picture = np.where(seen[..., None], predicted, 40).astype(np.uint8)
    return Verdict(score, unmoved, covered, psi, why), picture


def _own_colours(mesh: MorphMesh, pose: Matrix, screen: Screen, first: Image) -> Layer:
    """The mesh where it arrives, in the colours of its own picture alone."""
    alone = MorphMesh(
        mesh.points, mesh.destinations, mesh.uv, mesh.uv_second,
        np.zeros_like(mesh.psi), mesh.triangles, mesh.torn, mesh.round, mesh.marks,
    )  # fmt: skip
    return draw_mesh(alone, 1.0, inverse(pose), pose, screen, first, first, Mixing(doubt=np.inf))


def laid_over(picture: Image, own: Screen, other: Screen) -> Image:
    """A picture at the size of another screen, so that both principal points are at one place."""
    if own == other:
        return picture
    shift = np.subtract(other.centre_px, own.centre_px)
    moved = np.array([[1.0, 0.0, shift[0]], [0.0, 1.0, shift[1]]])
    size = (other.width_px, other.height_px)
    return np.asarray(cv2.warpAffine(picture, moved, size, borderMode=cv2.BORDER_REPLICATE))


def psnr(one: NDArray[np.uint8], other: NDArray[np.uint8]) -> float:
    """Peak signal to noise (dB) of two pictures' values."""
    error = float(np.mean((one.astype(np.float64) - other.astype(np.float64)) ** 2))
    return float(10.0 * np.log10(_PEAK**2 / max(error, 1e-9)))
