"""Hollow walls: which cells between lines are the insides of walls.

What tells a wall from a bed's head, a wardrobe or a pane, in this order:

1. The insides of walls run on around corners and past where walls meet. Those that do, are long
   and of even breadth, and have rooms on their sides, are walls. They say how broad walls are.
2. A line across a wall is where an opening begins or ends. So a cell in line with a wall that a
   line parts from it is an opening, and the next one is wall again.
3. Between open doors stand pieces of wall that touch nothing: they are as broad as a wall and in
   line with one.
4. A long straight cell between two rooms that is as broad as a wall, and whose end stands against
   the face of one, is a wall: faces run on where a wall meets them.
5. Where much stands free in the rooms that is as broad as walls are, it is walls, too.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import cache

import numpy as np
from numpy.typing import NDArray

from veduta.plan.walls.cells import Cells, common_values, tolerance

LONG = 10.0
"""Walls that say how broad walls are, are so many times as long as broad."""

EVEN = 0.72
"""They have one of two breadths along this part of their middle."""

STRAIGHT = 1.5
"""A cell is straight if the rectangle around it is at most so many times as broad as itself."""

BESIDE_ANOTHER = 0.7
"""What lies beside one other narrow cell for so much of its length is a pane or furniture."""

BESIDE_ROOMS = 0.4
"""At least so much of what lies beside a wall is no narrow cell, but a room or outdoors."""

A_SIDE = 0.15
"""A room is beside a wall if they share a line of this part of the wall's length."""

TURNS = 4.0
"""Walls around a corner are so many times as long as broad, at least."""

WIDER = 3.0
"""Beside walls between many rooms, what is so many times as broad is a space: a closet, a bath."""

LARGER = 5.0
"""A part of a tiled room is so many times as large as a piece of wall beside it."""

SPACIOUS = 8.0
"""On large plans rooms are narrow beside the sheet: so many times as broad as a wall is a room."""

WEB_REACH = 25.0
"""Walls between many rooms reach so many times their breadth."""

WEB_LEAST_PX = 3.0
"""What is narrower lies between two lines that run together."""

WEB_SPACES = 3
"""They have so many spaces beside them, each along some breadths of the wall, at least."""

WEB_SIDE = 4.0

WEB_ROOMS = 0.5
"""Or rooms along this part of their length."""

END = 1.7
"""Cells touch with an end if their common line is at most so many times as long as broad."""

IN_LINE_FARTHEST = 30.0
"""A piece of wall is in line with one that is at most so many times its breadth away."""

FACE_PX, BEHIND = 2.0, 3.0
"""The inside of a wall against which another stands is farther than the line of its face, and
nearer than so many breadths of that."""

FREE = 3.0
"""Walls that stand free are so many times as long as broad."""

FREE_SHARE = 0.25
"""They are walls if they are together so long, as a part of the others: less is furniture."""

RIM = 4.0
"""What lies around a basin is nowhere wider than so many times its usual breadth."""

MOST_ROUNDS = 20


def wall_cells(cells: Cells) -> NDArray[np.bool_]:
    """(n,) whether each cell is the inside of a wall; none where no cell says how broad."""
    return _Sorting(cells).walls()


class _Sorting:
    def __init__(self, cells: Cells) -> None:
        self.cells = cells
        # Asked in each round, and always the same.
        self.middle = cache(cells.middle)
        self.ahead: dict[int, list[NDArray[np.int32]]] = {}
        self.even: dict[int, tuple[list[float], float]] = {
            int(one): cells.widths(int(one))
            for one in np.flatnonzero(cells.narrow)
            if not self._is_rim(int(one))
        }
        self.wall = np.zeros(len(cells.area), dtype=np.bool_)
        self.opening = np.zeros(len(cells.area), dtype=np.bool_)
        self.breadths: list[float] = []

    def walls(self) -> NDArray[np.bool_]:
        first = [one for one in self.even if self._runs_on(one) or self._is_web(one)]
        if not first:
            return self.wall
        self.wall[first] = True
        along = np.concatenate([self.cells.ridges[one] for one in first])
        self.breadths = common_values(along, 4)[0]
        fitting = [one for one in self.even if not self.wall[one] and self._is_as_broad(one)]
        fitting = [one for one in fitting if self._is_between_rooms(one)]
        corners = [one for one in fitting if self._turns(one)]
        self.wall[corners] = True
        for _ in range(MOST_ROUNDS):
            while self._alternate(fitting):
                pass
            left = [one for one in fitting if not self.wall[one] and not self.opening[one]]
            new = next((one for one in left if self._stands_in_line(one)), None)
            if new is None:
                break
            self.wall[new] = True
        free = [one for one in fitting if not self.opening[one] and self._stands_free(one)]
        length = self.cells.length
        if length[free].sum() >= FREE_SHARE * length[self.wall].sum():
            self.wall[free] = True
        return self.wall

    def _is_rim(self, cell: int) -> bool:
        """Whether a cell is what lies around a basin: of a tub, a sink, a shower's tray.

        It goes all around one cell that touches nothing else but what lies in it, as a drain, and
        is hardly larger than that.
        """
        cells, breadth = self.cells, float(self.cells.breadth[cell])
        left, top, width, height = (float(value) for value in cells.boxes[cell])
        for other, _ in cells.beside.get(cell, []):
            x, y, wide, high = (float(value) for value in cells.boxes[other])
            sides = (x - left, y - top, left + width - x - wide, top + height - y - high)
            alone = all(one == cell or self._is_in(one, cell) for one, _ in cells.beside[other])
            if alone and not cells.room[other] and 0.0 < min(sides) <= max(sides) <= RIM * breadth:
                return True
        return False

    def _is_in(self, cell: int, other: int) -> bool:
        """Whether a cell lies in the box around another."""
        left, top, width, height = self.cells.boxes[cell]
        x, y, wide, high = self.cells.boxes[other]
        across = x <= left and left + width <= x + wide
        return bool(across and y <= top and top + height <= y + high)

    def _runs_on(self, cell: int) -> bool:
        """Whether a cell is a wall by itself: long, even, not straight, between two rooms."""
        cells = self.cells
        if cells.length[cell] < LONG * cells.breadth[cell] or self.even[cell][1] < EVEN:
            return False
        return (
            self._parts_rooms(cell) and self._is_between_rooms(cell) and not self._is_straight(cell)
        )

    def _is_web(self, cell: int) -> bool:
        """Whether a cell is a wall between many small spaces: even, far-reaching, not straight."""
        cells = self.cells
        breadth = float(cells.breadth[cell])
        if breadth < WEB_LEAST_PX or not self._reaches(cell) or self.even[cell][1] < EVEN:
            return False
        beside = cells.beside.get(cell, [])
        wide = [
            length
            for other, length in beside
            if cells.room[other] or cells.breadth[other] >= WIDER * breadth
        ]
        enough = sum(wide) >= BESIDE_ROOMS * sum(length for _, length in beside)
        spaces = sum(length >= WEB_SIDE * breadth for length in wide)
        # Where doors stand open, rooms and the corridor between them are one space.
        rooms = sum(length for other, length in beside if cells.room[other])
        many = spaces >= WEB_SPACES or rooms >= WEB_ROOMS * float(cells.length[cell])
        return enough and many and not self._is_straight(cell)

    def _parts_rooms(self, cell: int) -> bool:
        """Whether it has two rooms beside it, or one and what is outdoors."""
        least = A_SIDE * self.cells.length[cell]
        beside = self.cells.beside.get(cell, [])
        rooms = [
            other
            for other, length in beside
            if length >= least and (self.cells.room[other] or self._is_spacious(other, cell))
        ]
        return len(rooms) > 1

    def _is_spacious(self, other: int, cell: int) -> bool:
        """Whether a cell that is no room by the sheet's size is one beside this wall.

        What touches nothing but this cell lies inside of a rim, as of a bathtub.
        """
        broad = self.cells.breadth[other] >= SPACIOUS * self.cells.breadth[cell]
        alone = all(one == cell for one, _ in self.cells.beside[other])
        return bool(broad and not alone and self._reaches(cell))

    def _is_space(self, other: int, cell: int) -> bool:
        """Whether a narrow cell lies beside a piece of wall as rooms do.

        Of a tiled floor the lines part a room into cells that are narrow, but large.
        """
        cells = self.cells
        broad = cells.breadth[other] >= WIDER * cells.breadth[cell]
        large = cells.area[other] >= LARGER * cells.area[cell]
        alone = all(one == cell for one, _ in cells.beside[other])
        return bool(broad and large and not alone) or self._is_spacious(other, cell)

    def _reaches(self, cell: int) -> bool:
        return bool(max(self.cells.boxes[cell, 2:]) >= WEB_REACH * self.cells.breadth[cell])

    def _turns(self, cell: int) -> bool:
        """Whether a cell that is as broad as a wall goes around a corner."""
        long = self.cells.length[cell] >= TURNS * self.cells.breadth[cell]
        return bool(long and not self._is_straight(cell) and self._parts_rooms(cell))

    def _is_straight(self, cell: int) -> bool:
        _, _, _, short = self.middle(cell)
        return bool(short <= STRAIGHT * self.cells.breadth[cell] + 1)

    def _is_between_rooms(self, cell: int) -> bool:
        narrow = rooms = most = 0
        for other, length in self.cells.beside.get(cell, []):
            if self.cells.narrow[other] and not self._is_space(other, cell):
                narrow += length
                most = max(most, length)
            else:
                rooms += length
        # Where an outer and an inner wall are one cell, it is as long as the thinner one makes it.
        long_px = self.cells.area[cell] / max(min(self.even[cell][0]), 1.0)
        pane = most > BESIDE_ANOTHER * long_px and not self._blocky(cell)
        return bool(not pane and rooms >= BESIDE_ROOMS * (narrow + rooms))

    def _blocky(self, cell: int) -> bool:
        return bool(self.cells.length[cell] < 2.5 * self.cells.breadth[cell])

    def _is_as_broad(self, cell: int) -> bool:
        breadths, share = self.even[cell]
        near = [abs(breadths[0] - one) <= tolerance(np.array(one)) for one in self.breadths]
        return share >= EVEN and any(near)

    def _alternate(self, fitting: Iterable[int]) -> bool:
        """Cells at the ends of walls are openings, those at the ends of openings are walls.

        Returns whether any were found.
        """
        new = False
        for one in self.even:
            if self.wall[one] or self.opening[one]:
                continue
            ends = [other for other in self._at_ends(one) if self.wall[other]]
            if ends and self._in_line(one, ends):
                self.opening[one] = new = True
        for one in fitting:
            if self.wall[one] or self.opening[one]:
                continue
            beside = [other for other, _ in self.cells.beside.get(one, []) if self.opening[other]]
            if any(one in self._at_ends(other) for other in beside):
                self.wall[one] = new = True
        return new or self._stand_against_faces(fitting)

    def _stand_against_faces(self, fitting: Iterable[int]) -> bool:
        """Cells that stand against the face of a wall are walls; whether any were found."""
        left = [one for one in fitting if not self.wall[one] and not self.opening[one]]
        new = [one for one in left if self._stands_against_a_face(one)]
        self.wall[new] = True
        return bool(new)

    def _stands_against_a_face(self, cell: int) -> bool:
        """Whether a wall lies at once behind an end of a long straight cell between two rooms."""
        cells = self.cells
        if cells.length[cell] < LONG * cells.breadth[cell] or not self._is_straight(cell):
            return False
        if not self._parts_rooms(cell):
            return False
        centre, along, long, _ = self.middle(cell)
        steps = long / 2 + np.arange(FACE_PX, BEHIND * max(self.even[cell][0]) + 2 * FACE_PX)
        ahead = (self._label(centre + side * step * along) for side in (1, -1) for step in steps)
        return any(self.wall[one] for one in ahead)

    def _at_ends(self, cell: int) -> list[int]:
        """Narrow cells with which it shares a line about as long as itself is broad."""
        cells = self.cells
        breadth = cells.breadth[cell]
        return [
            other
            for other, length in cells.beside.get(cell, [])
            if cells.narrow[other] and 0.5 * breadth <= length <= END * breadth + 4
        ]

    def _in_line(self, opening: int, walls: list[int]) -> bool:
        """Whether one of the walls goes on in the direction of a straight cell at its end."""
        if not self._is_straight(opening):
            return False
        centre, along, long, _ = self.middle(opening)
        for wall in walls:
            away = long / 2 + 1.3 * max(self.even[wall][0]) + 4
            if any(self._label(centre + side * away * along) == wall for side in (1, -1)):
                return True
        return False

    def _stands_in_line(self, cell: int) -> bool:
        """Whether a wall of the same breadth lies ahead, with its middle on the same line."""
        if cell not in self.ahead:
            self.ahead[cell] = self._cells_in_line(cell)
        return any(self.wall[ahead].sum() >= 3 for ahead in self.ahead[cell])

    def _cells_in_line(self, cell: int) -> list[NDArray[np.int32]]:
        """For each end the cells (n,) that are as broad, one for each step ahead of it."""
        cells = self.cells
        breadth = float(cells.breadth[cell])
        found = []
        for end, way in self._ends(cell):
            steps = np.arange(3.0, IN_LINE_FARTHEST * breadth, 2.0)
            points = end + steps[:, None] * way
            x = np.clip(np.floor(points[:, 0]).astype(int), 0, cells.labels.shape[1] - 1)
            y = np.clip(np.floor(points[:, 1]).astype(int), 0, cells.labels.shape[0] - 1)
            here = 2.0 * cells.depth[y, x] - 1.0
            same = np.abs(here - breadth) <= float(tolerance(np.array(breadth)))
            found.append(cells.labels[y, x][same])
        return found

    def _ends(self, cell: int) -> list[tuple[NDArray[np.float64], NDArray[np.float64]]]:
        """The middle (2,) of each end, and the way (2,) out of it: of a corner, that of each arm.

        An end is no broader than the cell is at most places, or nearly so.
        """
        points, along = self.cells.points(cell), self.middle(cell)[1]
        breadth = float(self.cells.breadth[cell])
        across = along[::-1] * (-1, 1)
        found = []
        for way, side in ((along, across), (-along, across), (across, along), (-across, along)):
            ahead, aside = points @ way, points @ side
            far = float(ahead.max())
            last = aside[ahead > far - breadth / 2]
            if np.ptp(last) + 1 <= STRAIGHT * breadth:
                middle = (float(last.min()) + float(last.max())) / 2
                found.append((far * way + middle * side, way))
        return found

    def _stands_free(self, cell: int) -> bool:
        """Whether one space is all around a straight cell: on plans of bearing walls alone."""
        cells = self.cells
        beside = cells.beside.get(cell, [])
        around = len(beside) == 1 and bool(cells.room[beside[0][0]])
        long = cells.length[cell] >= FREE * cells.breadth[cell]
        return bool(around and long and self._is_straight(cell))

    def _label(self, point: NDArray[np.float64]) -> int:
        height, width = self.cells.labels.shape
        x, y = (int(np.floor(value)) for value in point)
        return int(self.cells.labels[y, x]) if 0 <= x < width and 0 <= y < height else 0
