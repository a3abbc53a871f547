"""`panoramas.json`: where the panoramas stand that were cut into views, and how they are turned.

No camera of the other files shows all around: they have the views alone.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from veduta.photos.intake.panoramas import cam_from_panorama
from veduta.photos.rigged import after, between
from veduta.photos.structure import Structure
from veduta.run.atomic import write_bytes

PANORAMAS = "panoramas.json"


def write_panoramas(components: Sequence[Structure], folder: Path) -> None:
    """Write it, where there are any; the file appears whole or not at all."""
    found = [
        one
        for number, structure in enumerate(components)
        for one in panoramas_in(structure, number)
    ]
    if found:
        document = {"schema": "veduta/panoramas", "version": 1, "panoramas": found}
        write_bytes(folder / PANORAMAS, json.dumps(document, indent=2).encode())


def panoramas_in(structure: Structure, component: int) -> list[dict[str, Any]]:
    """Each panorama of a component by the first of its views: all say the same.

    transform: (16,) column by column, world from panorama; of this x is right, y down, and z to the
    middle of the picture. In the frame that `georef.json` names for the component.
    """
    found: dict[str, dict[str, Any]] = {}
    for row, image in enumerate(structure.image_ids):
        view = structure.views.get(image)
        # Views that no rig holds were each placed for themselves: no one place is known.
        if view is None or image not in structure.frame_of or view.panorama in found:
            continue
        back = between(cam_from_panorama(view.number), np.eye(3, 4))
        from_world = np.vstack([after(back, structure.cam_from_world[row]), [0.0, 0.0, 0.0, 1.0]])
        found[view.panorama] = {
            "name": view.panorama,
            "component": component,
            "width_px": view.size_px[0],
            "height_px": view.size_px[1],
            "transform": np.linalg.inv(from_world).T.ravel().tolist(),
        }
    return [found[name] for name in sorted(found)]
