"""What closes the body behind the front: plain walls, the ground, and the roof."""

from __future__ import annotations

from collections.abc import Sequence

from veduta.facade.dormers import Dormer, add_dormers, slope_hole
from veduta.facade.paint import Paint
from veduta.facade.roof import Mansard
from veduta.place.builder import PartBuilder
from veduta.place.semantics import Provenance, SemanticClass


def add_plain_walls(
    builder: PartBuilder, footprint_m: tuple[float, float, float], paint: Paint
) -> None:
    """Right, back and left wall and the ground: no photo shows them.

    footprint_m: width, depth and height of the building up to the eaves.
    """
    x1, y1, z1 = footprint_m
    walls = {
        "right wall": [(x1, 0.0, 0.0), (x1, y1, 0.0), (x1, y1, z1), (x1, 0.0, z1)],
        "back wall": [(x1, y1, 0.0), (0.0, y1, 0.0), (0.0, y1, z1), (x1, y1, z1)],
        "left wall": [(0.0, y1, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, z1), (0.0, y1, z1)],
    }
    for name, corners in walls.items():
        width = x1 if name == "back wall" else y1
        feature = builder.feature(SemanticClass.WALL, Provenance.INVENTED, name, size_m=(width, z1))
        builder.polygon([corners], feature, paint.wall)
    ground = builder.feature(
        SemanticClass.GROUND, Provenance.INVENTED, "footprint", size_m=(x1, y1)
    )
    corners = [(0.0, 0.0, 0.0), (0.0, y1, 0.0), (x1, y1, 0.0), (x1, 0.0, 0.0)]
    builder.polygon([corners], ground, paint.wall)


def add_flat_roof(
    builder: PartBuilder, footprint_m: tuple[float, float, float], paint: Paint
) -> None:
    """The photo shows no roof: a flat one, marked as invented."""
    x1, y1, z1 = footprint_m
    flat = builder.feature(SemanticClass.ROOF, Provenance.INVENTED, "flat roof", size_m=(x1, y1))
    corners = [(0.0, 0.0, z1), (x1, 0.0, z1), (x1, y1, z1), (0.0, y1, z1)]
    builder.polygon([corners], flat, paint.roof)


def add_mansard(
    builder: PartBuilder,
    mansard: Mansard,
    dormers: Sequence[Dormer],
    setback_m: float,
    paint: Paint,
    front: Provenance,
) -> None:
    """Lower and upper slopes; the front's lower slope shows the photo and carries the dormers.

    `front` is where that slope comes from.
    """
    for name, corners in mansard.lower_slopes().items():
        seen = name == "front"
        feature = builder.feature(
            SemanticClass.ROOF,
            front if seen else Provenance.INVENTED,
            f"{name} lower slope",
        )
        if not seen:
            builder.polygon([corners], feature, paint.roof)
            continue
        finish = paint.surface(feature)
        holes = [slope_hole(dormer, mansard) for dormer in dormers]
        builder.polygon([corners, *holes], feature, finish.material, finish.uv)
        add_dormers(builder, dormers, mansard, setback_m, paint, feature)
    for name, corners in mansard.upper_slopes().items():
        feature = builder.feature(SemanticClass.ROOF, Provenance.INVENTED, f"{name} upper slope")
        builder.polygon([corners], feature, paint.roof)
