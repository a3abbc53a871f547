"""An independent oracle for closed surfaces: trimesh, on vertices equal to the last bit."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import trimesh

from veduta.place.part import Part


def shells(part: Part) -> Iterator[trimesh.Trimesh]:
    """Give each shell of a part as a mesh of its own, equal positions merged."""
    points, number = np.unique(part.positions_m, axis=0, return_inverse=True)
    faces = number.reshape(-1)[part.triangles.indices]
    shell = part.features.shell[part.polygon_feature[part.triangles.polygon]]
    for which in range(int(part.features.shell.max()) + 1):
        mesh = trimesh.Trimesh(points.astype(np.float64), faces[shell == which], process=False)
        mesh.remove_unreferenced_vertices()
        yield mesh


def assert_closed(part: Part) -> None:
    """Every shell is a closed, consistently wound 2-manifold that looks outwards."""
    for which, mesh in enumerate(shells(part)):
        assert len(mesh.faces) > 0, f"shell {which} is empty"
        assert mesh.is_watertight, f"shell {which} is open"
        assert mesh.is_winding_consistent, f"shell {which} is wound both ways"
        assert mesh.volume > 0.0, f"shell {which} is inside out"
        assert mesh.body_count == 1, f"shell {which} falls apart"
