"""The ground floor: what is shop front, what is wall, and where doors and windows are.

A door stands between wall: there is wall left, right and above it, and it is uniform and unlike
wall down to the street. A window has wall below it too. A shop front takes what is neither, from
its sign down. Each pixel votes for wall by its colour's distance to the wall right above, and for
door by being unlike wall and smooth; an exact chain over the pixel columns finds the best sequence
of wall and openings. Cars and people hide the lowest metre, so votes count less there.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.facade.appearance import Wall
from veduta.facade.boxes import Box
from veduta.facade.evidence import Evidence, Float, blur, blur_line
from veduta.facade.floors import Floors
from veduta.facade.ground_chain import Array, Gains, Kind, solve

# Lightness counts half of chroma times three, for shadows change the first and not the second.
_LAB_WEIGHT = (0.5, 1.5, 1.5)
# Colour distance at which a pixel is as likely wall as not, and that of one full vote.
_EVEN = 22.0
_VOTE = 14.0
# The same for doors: from that of a facade without shops to the most, for distances are cut at
# _FAR, and a door among other dark things must still be able to pass.
_DOOR_EVEN = (35.0, 70.0)
_DOOR_VOTE = 20.0
_FAR = 80.0
# Votes are clipped to this: evidence against is surer than evidence for (stone-coloured shops).
_CLIP = (-1.5, 1.0)
_SPREAD = 0.04
# In storeys of 3 m: cars stand up to 1 m above the street; what they leave to be seen counts less.
_CARS = 0.35
_CARS_WEIGHT = 0.3
# In storeys: shop fronts and signs may begin this far above and below the ground floor's top.
_SIGN = (0.2, 0.35)
# In storeys below the ground floor's top: heads of doors and windows (0 to 1.35 m), and sills,
# which end 0.3 m above the street at the lowest.
_HEAD = (0.05, 0.45)
_SILL = (0.5, 0.1)
# In storeys: widths of doors (0.85 to 2.7 m), windows (0.6 to 2.25 m), the narrowest shop front
# (2.4 m) and the narrowest pier (0.36 m).
_DOOR = (0.28, 0.9)
_WINDOW = (0.2, 0.75)
_SHOP = 0.8
_PIER = 0.12
# Gains in squared storeys, the area of full votes: of a standard deviation of edges at a jamb, of
# a storey's width of them at a head, sign or sill, of a storey's width of shop front, and of each
# change, door and window (prices).
_JAMB = 0.03
_LINE = 0.04
_SHOP_GAIN = 0.15
_CHANGE = -0.08
_DOOR_GAIN = -0.08
_WINDOW_GAIN = -0.12


@dataclass(frozen=True)
class _Votes:
    """Running sums, down the rows and to the right (n + 1, w + 1), in squared storeys.

    Row 0 is row `top` of the evidence; the ground floor's top is row `ground`. `edges` are sums to
    the right alone; `is_wall` (n, w) is true where wall is more likely than not.
    """

    top: int
    ground: int
    storey: float
    wall: Array
    door: Array
    edges: Array
    is_wall: NDArray[np.bool_]


def read_ground(evidence: Evidence, floors: Floors, wall: Wall) -> list[Box]:
    """Shop fronts, doors and windows of the ground floor; what they leave is wall."""
    storey = floors.mean_storey
    votes = _vote(evidence, floors, wall)
    last = votes.wall[-1] - votes.wall[votes.ground]
    door, window, (shop, pier) = (
        (max(1, int(a * storey)), max(1, int(b * storey)))
        for a, b in (_DOOR, _WINDOW, (_SHOP, _PIER))
    )
    kinds = [
        Kind("window", window, lambda starts, end: _window_gains(votes, starts, end)),
        Kind("door", door, lambda starts, end: _door_gains(votes, starts, end)),
        Kind("shop", (shop, evidence.width), lambda starts, end: _shop_gains(votes, starts, end)),
    ]
    boxes = []
    for o in solve(last, _jambs(evidence, votes), pier, kinds):
        score = _score(votes, (o.start, o.end, o.top, o.bottom), o.name == "shop")
        size = o.end - o.start, o.bottom - o.top
        boxes.append(Box(o.name, o.start, votes.top + o.top, *size, 0, None, score))
    return boxes


def _vote(evidence: Evidence, floors: Floors, wall: Wall) -> _Votes:
    storey = floors.mean_storey
    ground = min(int(_SIGN[0] * storey), floors.ground_top)
    top = floors.ground_top - ground
    spread = _SPREAD * storey
    unlike = blur(np.minimum(_unlike(evidence, wall, top, storey), _FAR), spread, spread)
    for_wall = np.clip((_EVEN - unlike) / _VOTE, *_CLIP)
    even = _door_even(unlike[ground:])
    for_door = np.clip((unlike - even) / _DOOR_VOTE, *_CLIP) - _rough(evidence, top, storey)
    height = np.arange(len(unlike), 0, -1)[:, None] / storey
    weight = np.where(height < _CARS, _CARS_WEIGHT, 1.0) / storey**2 * evidence.valid[top:]
    return _Votes(
        top,
        ground,
        storey,
        _running(_running(weight * for_wall, 0), 1),
        _running(_running(weight * for_door, 0), 1),
        _running(_lines(evidence, top) * _LINE / storey, 1),
        for_wall > 0,
    )


def _door_even(unlike: Float) -> float:
    """The distance at which a pixel of the ground floor is as likely door as not.

    Where half or more is not wall, doors are told from shops by being as unlike wall as half of
    that is; the less is not wall, the less there is to tell them from.
    """
    low, high = _DOOR_EVEN
    other = unlike[unlike > _EVEN]
    if not other.size:
        return low
    share = min(1.0, 2.0 * other.size / unlike.size)
    return low + share * (float(np.clip(np.median(other), low, high)) - low)


def _unlike(evidence: Evidence, wall: Wall, top: int, storey: float) -> Float:
    """Colour distance (n, w) to the wall above the ground floor in the same pixel column."""
    above = max(2, int(0.3 * storey))
    colour = np.median(wall.colour[-above:], axis=0)
    scaled = (evidence.lab[top:] - colour) * np.array(_LAB_WEIGHT, np.float32)
    return np.asarray(np.sqrt((scaled**2).sum(-1)), np.float32)


def _rough(evidence: Evidence, top: int, storey: float) -> Float:
    """Texture across y against its median, as a logarithm: goods and signs are above, doors below.

    Clipped to -1..1, so that it outweighs no full vote of the colour.
    """
    lightness = evidence.lab[top:, :, 0]
    detail = np.minimum(np.abs(lightness - blur(lightness, 0.0, storey / 48)), 30)
    texture = blur(detail, _SPREAD * storey, _SPREAD * storey) + 0.5
    return np.asarray(np.clip(np.log(texture / np.median(texture)), -1, 1), np.float32)


def _lines(evidence: Evidence, top: int) -> Array:
    """Horizontal edges (n + 1, w) at each row's upper side, in deviations of the rows' means."""
    edges = np.minimum(np.abs(evidence.gy[top:]), 20).astype(np.float64)
    rows = edges.mean(1)
    lines = np.clip((edges - rows.mean()) / (rows.std() + 1e-6), -2, 6)
    return np.vstack([lines, np.zeros((1, lines.shape[1]))])


def _jambs(evidence: Evidence, votes: _Votes) -> Array:
    """Gain (w + 1,) of a change between wall and opening, by the vertical edges there."""
    first = evidence.height - len(votes.is_wall) + votes.ground + int(_SIGN[0] * votes.storey)
    last = max(first + 1, evidence.height - int(_CARS * votes.storey))
    edges = np.minimum(np.abs(evidence.gx[first:last]), 20).mean(0)
    edges = blur_line(edges, 0.8)
    line = np.zeros(evidence.width + 1)
    line[1:-1] = np.maximum(edges[:-1], edges[1:])
    line = np.clip((line - line.mean()) / (line.std() + 1e-6), -1, 3)
    gain = _JAMB * line + _CHANGE
    gain[[0, -1]] = 0.0
    return np.asarray(gain, np.float64)


def _running(values: NDArray[np.floating], axis: int) -> Array:
    """Running sums along an axis, with a zero first."""
    sums = np.cumsum(values, axis=axis, dtype=np.float64)
    return np.insert(sums, 0, 0.0, axis=axis)


def _stretch(sums: Array, rows: NDArray[np.int64], starts: slice, end: int) -> Array:
    """Sums (rows, starts) between each start and the end, at some rows of running sums."""
    return np.asarray(sums[rows, end][:, None] - sums[rows, starts], np.float64)


def _heads(votes: _Votes, span: tuple[float, float]) -> NDArray[np.int64]:
    first, last = (votes.ground + int(part * votes.storey) for part in span)
    return np.arange(max(0, first), min(len(votes.is_wall), max(last, first + 1)))


def _above(votes: _Votes, rows: NDArray[np.int64], starts: slice, end: int) -> Array:
    """Gain (rows, starts) of wall from the ground floor's top to a row, and of an edge there."""
    whole = _stretch(votes.wall, np.array([votes.ground]), starts, end)
    wall = _stretch(votes.wall, rows, starts, end) - whole
    return np.asarray(wall + _stretch(votes.edges, rows, starts, end), np.float64)


def _shop_gains(votes: _Votes, starts: slice, end: int) -> Gains:
    rows = _heads(votes, (-_SIGN[0], _SIGN[1]))
    gain = _above(votes, rows, starts, end)
    widths = end - np.arange(starts.start, starts.stop)
    bottom = np.full(len(widths), len(votes.is_wall))
    value = gain.max(0) + _SHOP_GAIN * widths / votes.storey
    return Gains(value, rows[gain.argmax(0)], bottom)


def _door_gains(votes: _Votes, starts: slice, end: int) -> Gains:
    rows = _heads(votes, (0.0, _HEAD[1]))
    below = _stretch(votes.door, np.array([-1]), starts, end)
    gain = _above(votes, rows, starts, end) + below - _stretch(votes.door, rows, starts, end)
    bottom = np.full(gain.shape[1], len(votes.is_wall))
    return Gains(gain.max(0) + _DOOR_GAIN, rows[gain.argmax(0)], bottom)


def _window_gains(votes: _Votes, starts: slice, end: int) -> Gains:
    rows = _heads(votes, _HEAD)
    first = votes.ground + int(_SILL[0] * votes.storey)
    sills = np.arange(first, max(first + 1, len(votes.is_wall) - int(_SILL[1] * votes.storey)))
    sills = np.minimum(sills, len(votes.is_wall))
    head = _above(votes, rows, starts, end)
    below = _stretch(votes.wall, np.array([-1]), starts, end)
    sill = below - _stretch(votes.wall, sills, starts, end)
    sill += _stretch(votes.edges, sills, starts, end)
    value = head.max(0) + sill.max(0) + _WINDOW_GAIN
    return Gains(value, rows[head.argmax(0)], sills[sill.argmax(0)])


def _score(votes: _Votes, box: tuple[int, int, int, int], shop: bool) -> float:
    """Share of the pixels that agree: inside unlike wall; beside a door or window, wall."""
    start, end, top, bottom = box
    unlike = 1.0 - float(votes.is_wall[top:bottom, start:end].mean())
    if shop:
        return unlike
    pier = max(1, int(_PIER * votes.storey))
    sides = [
        votes.is_wall[top:bottom, max(0, start - pier) : start],
        votes.is_wall[top:bottom, end : end + pier],
    ]
    beside = np.concatenate([side.ravel() for side in sides])
    return (unlike + float(beside.mean())) / 2 if beside.size else unlike
