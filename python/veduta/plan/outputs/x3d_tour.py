"""The guided tour in X3D: a viewpoint that walks when one goes to it, again and again."""

from __future__ import annotations

import numpy as np

from veduta.formats.x3d import X3dScene, look_from, place_of
from veduta.place.manifest import Tour

KEY_S = 0.25
"""Keys of the way and of the look are at most so dense."""


def add_tour(scene: X3dScene, tour: Tour, field_of_view: float) -> None:
    """A viewpoint on the way, with the clock that starts when the viewpoint is chosen."""
    times = np.array(tour.times_s)
    rows = _kept(times)
    eyes = [np.array(tour.eyes[row]) for row in rows]
    looks = [look_from(eye, eye + np.array(tour.directions[row])) for eye, row in
             zip(eyes, rows, strict=True)]  # fmt: skip
    share = times[rows] / times[-1]
    view = scene.node(
        scene.scene, "Viewpoint", f"tour {tour.id}", description=tour.name,
        position=place_of(eyes[0]), orientation=looks[0], fieldOfView=field_of_view,
    )  # fmt: skip
    clock = scene.node(
        scene.scene,
        "TimeSensor",
        f"tour {tour.id} clock",
        cycleInterval=float(times[-1]),
        loop=False,
    )
    scene.route(view, "bindTime", clock, "set_startTime")
    for kind, values, field in (
        ("Position", [place_of(eye) for eye in eyes], "position"),
        ("Orientation", looks, "orientation"),
    ):
        way = scene.node(
            scene.scene,
            f"{kind}Interpolator",
            f"tour {tour.id} {field}",
            key=share,
            keyValue=values,
        )
        scene.route(clock, "fraction_changed", way, "set_fraction")
        scene.route(way, "value_changed", view, f"set_{field}")


def _kept(times: np.ndarray) -> list[int]:
    """The first key, the last, and those between that are far enough apart."""
    kept = [0]
    for row in range(1, len(times) - 1):
        if times[row] - times[kept[-1]] >= KEY_S and times[-1] - times[row] >= KEY_S:
            kept.append(row)
    return [*kept, len(times) - 1]
