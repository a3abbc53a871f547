"""Where on the Earth a town stands, and that it stands on its own where a part of it cannot."""

from __future__ import annotations

import numpy as np

from veduta.grammar.block import Block
from veduta.grammar.lots import Lots
from veduta.grammar.placing import placed_how, town_of
from veduta.grammar.report import Whole

LOTS = Lots((), "EPSG:32631", (450_000.0, 5_410_000.0, 0.0))
NEAR, FAR = Block("parts/00", (), (0.0, 0.0, 0.0)), Block("parts/01", (), (1e9, 0.0, 0.0))
BOX = {"box": [[0.0, 0.0, 0.0], [1.0, 1.0, 1.0]]}


def test_blocks_within_the_projection_stand_on_the_earth() -> None:
    tile = town_of(LOTS, [NEAR], Whole(blocks=[("parts/00", BOX)]), {})
    assert tile.transform is not None
    assert placed_how(LOTS, [NEAR]).startswith("the tiles stand on the Earth by WGS 84 / UTM")


def test_one_block_outside_the_projection_leaves_all_in_metres() -> None:
    blocks = [NEAR, FAR]
    tile = town_of(LOTS, blocks, Whole(blocks=[(block.name, BOX) for block in blocks]), {})
    assert tile.transform is None
    assert [child.transform[0, 3] for child in tile.children if child.transform is not None] == [
        0.0,
        1e9,
    ]
    assert np.allclose(tile.box[1], (1e9 + 1, 1, 1))
    assert "has no place where the lots lie" in placed_how(LOTS, blocks)
