"""Train the eyes of `veduta facade`, and write them as ONNX.

    python training/facade/prepare.py SETS --renders RENDERS
    python training/facade/sprites.py SETS
    python training/facade/train.py SETS OUT --minutes 19

Needs torch, onnx and onnxscript, which the package itself never does, and wants a GPU: about twenty
minutes of one, or days of a processor. OUT gets `eyes.onnx` (weights at half precision) and
`eyes.pt`.
"""

from __future__ import annotations

import argparse
import copy
import math
import time
from pathlib import Path

import numpy as np
import torch
from batches import Batch, Pictures, Sprites, draw
from classes import CLASSES, KINDS
from network import Eyes
from torch import Tensor, nn
from torch.nn import functional
from write_onnx import write_onnx

WEIGHTS = {
    "door": 3.0,
    "balcony": 2.0,
    "shop": 1.6,
    "window": 1.5,
    "vehicle": 1.3,
    "person": 1.5,
    "roof": 1.3,
    "sill": 1.5,
}
KEPT = 0.999


def main() -> None:
    """Train for the time that is given."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("sets", type=Path)
    parser.add_argument("out", type=Path)
    parser.add_argument("--minutes", type=float, default=19.0)
    parser.add_argument("--batch", type=int, default=64)
    parser.add_argument("--rate", type=float, default=2.5e-3)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--all", action="store_true", help="train on the held out pictures too")
    call = parser.parse_args()
    device = "cuda" if torch.cuda.is_available() else "cpu"
    torch.manual_seed(call.seed)
    torch.backends.cudnn.benchmark = True
    pictures = Pictures(call.sets, device, None if call.all else False)
    sprites = Sprites(call.sets, device)
    eyes = Eyes().to(device).to(memory_format=torch.channels_last)
    print(
        sum(p.numel() for p in eyes.parameters()),
        "weights,",
        len(pictures.names),
        "pictures",
        flush=True,
    )
    kept = train(eyes, pictures, sprites, call)
    call.out.mkdir(parents=True, exist_ok=True)
    torch.save(kept.state_dict(), call.out / "eyes.pt")
    write_onnx(kept.cpu().eval(), call.out / "eyes.onnx")


def train(eyes: Eyes, pictures: Pictures, sprites: Sprites, call: argparse.Namespace) -> Eyes:
    """The mean of the weights over the last steps; the rate falls with the time that is left."""
    rng = np.random.default_rng(call.seed)
    kept = copy.deepcopy(eyes).eval()
    decayed = [p for p in eyes.parameters() if p.ndim > 1]
    others = [p for p in eyes.parameters() if p.ndim <= 1]
    groups = [{"params": decayed, "weight_decay": 0.04}, {"params": others, "weight_decay": 0.0}]
    adam = torch.optim.AdamW(groups, lr=call.rate, betas=(0.9, 0.99))
    weights = torch.tensor([WEIGHTS.get(name, 1.0) for name in CLASSES], device=pictures.device)
    start, step, said = time.monotonic(), 0, 0.0
    while (gone := (time.monotonic() - start) / (60 * call.minutes)) < 1.0:
        rate = (
            call.rate * min(1.0, (step + 1) / 200) * (0.5 + 0.5 * math.cos(math.pi * gone)) + 1e-6
        )
        for group in adam.param_groups:
            group["lr"] = rate
        batch = draw(pictures, sprites, call.batch, rng)
        with torch.autocast(pictures.device, torch.bfloat16):
            made = eyes(batch.pixels.contiguous(memory_format=torch.channels_last))
        parts = losses(made, batch, weights)
        adam.zero_grad(set_to_none=True)
        sum(parts.values()).backward()
        nn.utils.clip_grad_norm_(eyes.parameters(), 5.0)
        adam.step()
        _follow(kept, eyes, min(KEPT, (step + 1) / (step + 10)))
        step += 1
        if time.monotonic() - start - said > 15 or step in (1, 20):
            said = time.monotonic() - start
            told = " ".join(f"{name} {float(value):.3f}" for name, value in parts.items())
            print(f"{said:6.1f} s  step {step}  rate {rate:.2e}  {told}", flush=True)
    return kept


@torch.no_grad()
def _follow(kept: nn.Module, eyes: nn.Module, share: float) -> None:
    mine, theirs = kept.state_dict(), eyes.state_dict()
    floats = [name for name, value in mine.items() if value.dtype.is_floating_point]
    torch._foreach_lerp_([mine[n] for n in floats], [theirs[n] for n in floats], 1.0 - share)


def losses(made: tuple[Tensor, Tensor, Tensor], batch: Batch, weights: Tensor) -> dict[str, Tensor]:
    """What is wrong with the classes, the centres and the borders."""
    scores, centres, borders = (each.float() for each in made)
    every = torch.logsumexp(scores, 1)
    right = torch.logsumexp(scores.masked_fill(~batch.allowed, -1e4), 1)
    single = batch.allowed.sum(1) == 1
    weight = torch.where(single, (batch.allowed * weights[None, :, None, None]).sum(1), 0.6)
    weight = weight * (batch.allowed.sum(1) < len(CLASSES))
    classes = ((every - right) * weight).sum() / weight.sum().clamp(min=1)
    there = batch.kind >= 0
    across, along = batch.borders[:, 0::2], batch.borders[:, 1::2]
    middle = (across.amin(1) / across.amax(1) * along.amin(1) / along.amax(1)).sqrt() * there
    target = (
        functional.one_hot((batch.kind + 2).clamp(min=0), len(KINDS) + 3)[..., 2:-1].permute(
            0, 3, 1, 2
        )
        * middle[:, None]
    )
    known = ((batch.kind != -2) & (batch.kind != len(KINDS)))[:, None]
    chance = centres.sigmoid()
    missed = functional.binary_cross_entropy_with_logits(centres, target, reduction="none")
    focal = missed * (target - chance).abs() ** 2 * known
    size = middle.sum().clamp(min=1)
    return {
        "classes": classes,
        "centres": 2.0 * focal.sum() / size,
        "borders": (_giou_loss(borders, batch.borders) * middle).sum() / size,
    }


def _giou_loss(made: Tensor, true: Tensor) -> Tensor:
    """1 - GIoU of two boxes about one point, (n, h, w)."""
    area = (made[:, 0] + made[:, 2]) * (made[:, 1] + made[:, 3])
    other = (true[:, 0] + true[:, 2]) * (true[:, 1] + true[:, 3])
    low, high = torch.minimum(made, true), torch.maximum(made, true)
    both = (low[:, 0] + low[:, 2]) * (low[:, 1] + low[:, 3])
    hull = (high[:, 0] + high[:, 2]) * (high[:, 1] + high[:, 3])
    union = area + other - both
    return 1 - both / union + (hull - union) / hull


if __name__ == "__main__":
    main()
