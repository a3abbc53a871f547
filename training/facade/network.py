"""The network: an encoder of depthwise blocks, a decoder to half of the picture's size, two heads.

About 2.4 million weights, so that they fit into 5 MB at half precision. Everything is convolution
but one mean over the picture, so any size of picture will do.
"""

from __future__ import annotations

import torch
from classes import CLASSES, KINDS
from torch import Tensor, nn
from torch.nn import functional

WIDTHS = (32, 64, 112, 176, 208)
DEPTHS = (0, 2, 3, 6, 3)
DECODER = 96
BOX_UNIT_PX = 16.0


def _conv(
    inside: int, outside: int, kernel: int = 3, stride: int = 1, groups: int = 1
) -> nn.Sequential:
    layer = nn.Conv2d(inside, outside, kernel, stride, kernel // 2, groups=groups, bias=False)
    return nn.Sequential(layer, nn.BatchNorm2d(outside))


class Block(nn.Module):
    """A depthwise 5 x 5 convolution, then two layers over the channels, beside a way past them."""

    def __init__(self, width: int) -> None:
        super().__init__()
        self.spatial = _conv(width, width, 5, groups=width)
        self.up = _conv(width, 2 * width, 1)
        self.down = _conv(2 * width, width, 1)

    def forward(self, x: Tensor) -> Tensor:
        """(n, c, h, w) to the same."""
        return x + self.down(functional.relu(self.up(self.spatial(x))))


class Whole(nn.Module):
    """What the picture is as a whole, added at every place."""

    def __init__(self, width: int) -> None:
        super().__init__()
        self.first = nn.Conv2d(width, width // 2, 1)
        self.second = nn.Conv2d(width // 2, width, 1)

    def forward(self, x: Tensor) -> Tensor:
        """(n, c, h, w) to the same."""
        mean = x.mean(dim=(2, 3), keepdim=True)
        return x + self.second(functional.relu(self.first(mean)))


class Eyes(nn.Module):
    """Pixels (n, 3, h, w), sRGB from 0 to 1, h and w multiples of 32, to three maps.

    Class scores (n, classes, h/2, w/2); centre scores of the kinds (n, kinds, h/4, w/4), high in
    the middle of an element and low at its border; and (n, 4, h/4, w/4) how far its left, upper,
    right and lower border are (px).
    """

    def __init__(self) -> None:
        super().__init__()
        self.stem = nn.Sequential(
            _conv(3, WIDTHS[0], 3, 2), nn.ReLU(), _conv(WIDTHS[0], WIDTHS[0]), nn.ReLU()
        )
        stages = []
        for before, width, depth in zip(WIDTHS[:-1], WIDTHS[1:], DEPTHS[1:], strict=True):
            blocks = [Block(width) for _ in range(depth)]
            stages.append(nn.Sequential(_conv(before, width, 3, 2), nn.ReLU(), *blocks))
        self.stages = nn.ModuleList(stages)
        self.whole = Whole(WIDTHS[-1])
        self.laterals = nn.ModuleList(nn.Conv2d(width, DECODER, 1) for width in WIDTHS[1:])
        self.mixed = nn.ModuleList(Block(DECODER) for _ in WIDTHS[1:-1])
        self.fine = nn.Sequential(_conv(DECODER, 48, 1), nn.ReLU())
        self.edge = _conv(WIDTHS[0], 48, 1)
        self.sharp = nn.Sequential(Block(48), Block(48))
        self.classes = nn.Conv2d(48, len(CLASSES), 1)
        self.elements = nn.Sequential(
            _conv(DECODER, DECODER, 5, groups=DECODER), Block(DECODER), Block(DECODER)
        )
        self.centres = nn.Conv2d(DECODER, len(KINDS), 1)
        self.borders = nn.Conv2d(DECODER, 4, 1)
        nn.init.constant_(self.centres.bias, -3.0)

    def forward(self, pixels: Tensor) -> tuple[Tensor, Tensor, Tensor]:
        """See the class."""
        half = self.stem(2.0 * pixels - 1.0)
        x, levels = half, []
        for stage in self.stages:
            x = stage(x)
            levels.append(x)
        x = self.laterals[-1](self.whole(levels[-1]))
        for level, lateral, mix in zip(
            levels[-2::-1], self.laterals[-2::-1], self.mixed, strict=True
        ):
            x = mix(functional.interpolate(x, scale_factor=2.0, mode="bilinear") + lateral(level))
        fine = functional.interpolate(self.fine(x), scale_factor=2.0, mode="bilinear")
        scores = self.classes(self.sharp(functional.relu(fine + self.edge(half))))
        y = self.elements(x)
        borders = torch.exp(self.borders(y).float().clamp(-4.0, 4.0)) * BOX_UNIT_PX
        return scores, self.centres(y), borders
