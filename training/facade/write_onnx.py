"""The network as ONNX: weights at half precision, computed with at single precision."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import onnx
import torch
from classes import CLASSES, KINDS
from onnx import TensorProto, helper, numpy_helper
from torch import Tensor, nn

SMALL = 256


class _Told(nn.Module):
    """Probabilities instead of scores."""

    def __init__(self, eyes: nn.Module) -> None:
        super().__init__()
        self.eyes = eyes

    def forward(self, pixels: Tensor) -> tuple[Tensor, Tensor, Tensor]:
        scores, centres, borders = self.eyes(pixels)
        return scores.softmax(1), centres.sigmoid(), borders


def write_onnx(eyes: nn.Module, path: Path) -> None:
    """Export with free height and width, and halve what the weights take."""
    told = _Told(eyes.float().cpu()).eval()
    names = ["classes", "centres", "borders"]
    free = {"pixels": {2: "height", 3: "width"}}
    free |= {name: {2: f"{name}_height", 3: f"{name}_width"} for name in names}
    example = torch.rand(1, 3, 256, 320)
    torch.onnx.export(
        told, (example,), str(path), input_names=["pixels"], output_names=names,
        dynamic_axes=free, opset_version=17, dynamo=False,
    )  # fmt: skip
    model = onnx.load(str(path))
    _halve(model)
    for key, value in (("classes", CLASSES), ("kinds", KINDS)):
        entry = model.metadata_props.add()
        entry.key, entry.value = key, json.dumps(value)
    onnx.checker.check_model(model)
    onnx.save(model, str(path))
    print(path, path.stat().st_size, "bytes", flush=True)


def _halve(model: onnx.ModelProto) -> None:
    graph, casts = model.graph, []
    for weights in graph.initializer:
        if weights.data_type != TensorProto.FLOAT or np.prod(weights.dims) < SMALL:
            continue
        values = numpy_helper.to_array(weights).astype(np.float16)
        name = weights.name
        weights.CopyFrom(numpy_helper.from_array(values, f"{name}_half"))
        casts.append(helper.make_node("Cast", [f"{name}_half"], [name], to=TensorProto.FLOAT))
    nodes = [*casts, *graph.node]
    del graph.node[:]
    graph.node.extend(nodes)
