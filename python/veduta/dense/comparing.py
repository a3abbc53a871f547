"""The cloud held against a city model: a coloured layer of the place, and what the report says."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from veduta.cameras import CameraSet
from veduta.dense.build.cloud import DenseCloud
from veduta.dense.build.model_distance import (
    DistanceParameters,
    ModelDistance,
    histogram,
    legend_picture,
    model_distance,
)
from veduta.dense.document import CityMesh
from veduta.formats.laz import write_laz
from veduta.run.page import Bars
from veduta.run.work import Work

DISTANCES = "model_distances.laz"
FEW = 0.05
"""Share of the points below which a model hardly shows what the photos show."""


def compare_with_model(
    work: Work,
    cloud: DenseCloud,
    cameras: CameraSet,
    model: CityMesh,
    reach_m: float,
    parameters: DistanceParameters,
) -> NDArray[np.uint8]:
    """The colours of the cloud's points by their distances, which are measured and written."""
    with work.step("city model") as step:
        for note in model.notes:
            work.note(note)
        found = model_distance(cloud.points_m, model, reach_m, parameters)
        count = int(found.compared.sum())
        step.counts.update(
            buildings=model.buildings, triangles=len(model.triangles), compared=count
        )
        write_laz(
            cloud.points_m,
            found.colours,
            work.folder / DISTANCES,
            crs=cameras.crs,
            origin_m=cameras.origin_m,
            extra={"distance_m": found.distances_m.astype(np.float32)},
        )
        work.file(DISTANCES, "all points coloured by their distances from the model, and these")
        _tell(work, found)
    return found.colours


def _tell(work: Work, found: ModelDistance) -> None:
    figures = found.figures()
    for name, value in figures.items():
        work.measure(f"model_{name}", value)
    share, reach = 100.0 * figures["compared_share"], found.reach_m
    if figures["compared_share"] < FEW:
        work.doubt(
            f"{share:.1f} % of the points lie within {reach:g} m of the city model: does it show "
            "these houses, and in these heights?"
        )
    if "median_m" not in figures:
        return
    work.fact(
        "From the city model",
        f"half within {figures['median_m']:.2f} m, 90 % within {figures['p90_m']:.2f} m",
    )
    work.note(
        f"{share:.1f} % of the points lie within {reach:g} m of the city model and are compared; "
        f"their middle lies {abs(figures['signed_median_m']):.3f} m "
        f"{'behind' if figures['signed_median_m'] < 0 else 'before'} its walls and roofs."
    )
    edges, shares = histogram(found)
    title = f"Distances from the city model: from {-found.range_m:g} m to {found.range_m:g} m"
    note = "blue: behind its walls and roofs; red: before them; outermost: what lies beyond, too"
    work.picture(title, note, legend_picture(found), wide=True)
    rows = [
        (f"{low:+.3g} to {high:+.3g} m", round(float(one), 1))
        for low, high, one in zip(edges[:-1], edges[1:], shares, strict=True)
    ]
    work.bars(Bars("Points by their distance from the city model", "%", rows))
