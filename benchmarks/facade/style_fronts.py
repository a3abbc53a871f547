"""Fronts of styles whose structure is known: drawn by rules, rendered, and read as photos are."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta import _core
from veduta.facade.analyse import analyse
from veduta.facade.document import FacadeDocument, Source
from veduta.facade.eyes import look
from veduta.facade.options import FacadeOptions, RectifyOptions
from veduta.facade.rectify import rectify
from veduta.facade.style.elevation import instance_boxes
from veduta.facade.style.grammar import DEPTH_M, StyleGrammar, style_grammar
from veduta.facade.style.observed import Observed, observe
from veduta.facade.style.prior import Real
from veduta.facade.style.state import SCALE, State
from veduta.grammar.building import build_part
from veduta.grammar.edits import Edit
from veduta.grammar.portrait import turned
from veduta.imaging.read import Photo
from veduta.place.part import Part
from veduta.run.errors import NotFoundError
from veduta.synthetic.camera import look_at
from veduta.synthetic.light import daylight
from veduta.synthetic.render import render
from veduta.synthetic.scene import RayScene

LONG_PX = 640
FAR_M = 120.0
ABOVE_M = 2.0
WIDTHS_M = (9.0, 16.0)
_ONE = Real(1.0, 1.0, 0.99, 1.01)


@dataclass(frozen=True)
class TrueFront:
    """A rendered front: the structure that it was drawn from, on a lot `width_m` wide.

    pixels: (h, w, 3) uint8 sRGB, fronto-parallel, with the lot's borders as its own. placed: lower
    and upper corners (n, 3) in metres of the library's assets, by name.
    """

    style: str
    state: State
    width_m: float
    pixels: NDArray[np.uint8]
    px_per_m: float
    placed: dict[str, tuple[NDArray[np.float64], NDArray[np.float64]]]


@dataclass(frozen=True)
class ReadFront:
    """What the first half makes of a picture; `document` is None where it is refused."""

    document: FacadeDocument | None
    observed: Observed | None
    reason: str = ""


def true_front(
    style: str, seed: int, long_px: int = LONG_PX, fixed: Mapping[str, str] | None = None
) -> TrueFront:
    """A front of a style by chance: attributes as the rules draw them, choices, width.

    fixed: attributes that are not drawn.
    """
    rng = np.random.default_rng([seed, len(style)])
    width = float(rng.uniform(*WIDTHS_M))
    grammar = style_grammar(style, width, _ONE)
    state = State({**_drawn(grammar, width, seed), **(fixed or {}), SCALE: 1.0}, {})
    derived = grammar.complete(state, rng)
    if derived is None:
        raise ValueError(f"{style} makes nothing of {width:.1f} m")
    part, top, placed = _part(grammar, derived.state, width, seed)
    pixels, scale = _photo(part, width, top, seed, long_px)
    return TrueFront(style, derived.state, width, pixels, scale, placed)


def _drawn(grammar: StyleGrammar, width_m: float, seed: int) -> dict[str, bool | float | str]:
    """The attributes that the rules themselves draw."""
    tree = _core.Derivation(grammar.rules.core, _lot(width_m), seed, attributes={"LOD": 1.0})
    own = {name: value for name, is_attribute, value in tree.values if is_attribute}
    start = grammar.start().attributes
    return {name: own.get(name, value) for name, value in start.items() if name != SCALE}


def _part(
    grammar: StyleGrammar, state: State, width_m: float, seed: int
) -> tuple[Part, float, dict[str, tuple[NDArray[np.float64], NDArray[np.float64]]]]:
    """The building with the structure's choices, its highest point, and where assets stand."""
    attributes = {name: value for name, value in state.attributes.items() if name != SCALE}
    edits = [
        Edit(path, taken.rule, choices=taken.alternatives).core
        for path, taken in sorted(state.choices.items())
    ]
    tree = grammar.rules.with_assets(
        lambda: _core.Derivation(
            grammar.rules.core,
            _lot(width_m),
            seed,
            attributes={**attributes, "LOD": 2.0},
            edits=edits,
        )
    )
    if tree.edit_faults:
        raise ValueError(f"{grammar.name}: {tree.edit_faults[:2]}")
    columns = tree.columns()
    assets = grammar.rules.library.assets_of(columns)
    part = build_part(columns, "front", assets, grammar.rules.textures)
    low, high = instance_boxes(columns, assets)
    names = [name.rpartition("/")[2].partition("@")[0] for name in columns.asset_names]
    own = np.array([names[place] for place in columns.instance_asset.tolist()])
    placed = {name: (low[own == name], high[own == name]) for name in set(names)}
    return turned(part, np.array([1.0, 0.0])), float(part.bounds_m[1][2]), placed


def _lot(width_m: float) -> list[list[tuple[float, float, float]]]:
    return [[(0.0, 0.0, 0.0), (width_m, 0.0, 0.0), (width_m, DEPTH_M, 0.0), (0.0, DEPTH_M, 0.0)]]


def _photo(
    part: Part, width_m: float, top_m: float, seed: int, long_px: int
) -> tuple[NDArray[np.uint8], float]:
    """From far away and straight ahead, the sun over the street; with the pixels of a metre."""
    rng = np.random.default_rng([seed, 1])
    height = top_m + ABOVE_M
    scale = long_px / max(height, width_m)
    size = round(width_m * scale), round(height * scale)
    middle = (0.5 * width_m, -FAR_M, 0.5 * height)
    camera = look_at(middle, (middle[0], 0.0, middle[2]), size, scale * FAR_M)
    azimuth = -np.pi / 2 + float(rng.uniform(0.3, 0.9)) * float(rng.choice([-1.0, 1.0]))
    light = daylight(seed, bool(rng.random() < 0.5), azimuth, float(rng.uniform(0.6, 0.95)))
    radiance = render(RayScene([(part, np.eye(4))]), camera, light, 1, seed)
    exposed = np.clip(radiance / np.percentile(radiance, 97), 0.0, 1.0)
    noisy = exposed ** (1 / 2.2) + rng.normal(0.0, 0.012, exposed.shape)
    return np.asarray(np.rint(255.0 * np.clip(noisy, 0.0, 1.0)), np.uint8), scale


def read_front(pixels: NDArray[np.uint8], name: str) -> ReadFront:
    """Read a fronto-parallel picture of a whole front as `veduta facade --corners` does."""
    height, width = pixels.shape[:2]
    corners = (0.0, 0.0, float(width), 0.0, float(width), float(height), 0.0, float(height))
    options = FacadeOptions(rectify=RectifyOptions(corners=corners))
    photo = Photo(pixels, "0" * 64, None, None, Path(name))
    source = Source(image=name, sha256="0" * 64, width_px=width, height_px=height)
    try:
        rectified = rectify(photo, options.rectify)
        document, _ = analyse(rectified, source, options)
    except NotFoundError as error:
        return ReadFront(None, None, str(error))
    return ReadFront(document, observe(look(rectified.pixels), document))
