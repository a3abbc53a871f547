"""From a layout to a mesh with features: wall and openings, balconies, roof, street."""

from __future__ import annotations

from dataclasses import dataclass

from veduta.synthetic.ironwork import add_balcony, add_screen
from veduta.synthetic.layout import Band, Layout, Opening, Rect
from veduta.synthetic.looks import Look, make_looks, opening_material
from veduta.synthetic.mesh import Mesh, MeshBuilder, wall_cells
from veduta.synthetic.roofs import add_roof
from veduta.synthetic.street import Occluder, add_ground, add_occluder, street_looks

# Lower and upper edge as shares of the height, reach as a share of the projection.
CORNICE_STEPS = ((0.0, 0.45, 0.4), (0.45, 0.75, 0.7), (0.75, 1.0, 1.0))


@dataclass(frozen=True)
class Feature:
    """One thing that a label image can show. `rect` is what it covers of the facade, if known."""

    class_: str
    name: str
    rect: Rect | None = None


@dataclass(frozen=True)
class BuiltFacade:
    """The mesh to look at, flat `screens` for labels, and the tables that both refer to.

    The screens are what a person who labels a photo would outline: an opening with its reveals, a
    balcony with the gaps between its bars.
    """

    mesh: Mesh
    screens: Mesh
    materials: tuple[str, ...]
    looks: dict[str, Look]
    features: tuple[Feature, ...]


def build(
    layout: Layout,
    seed: int,
    occluders: tuple[tuple[Occluder, float], ...] = (),
    street: bool = True,
) -> BuiltFacade:
    """Build the facade, its body and (if asked) its street; `occluders` are (kind, x in metres)."""
    looks = make_looks(layout, seed) | (street_looks(seed) if street else {})
    tiles = {name: look.tile_m for name, look in looks.items()}
    builder = MeshBuilder(tiles)
    screens = MeshBuilder(tiles)
    table = _FeatureTable()
    wall = table.add(Feature("wall", "wall", Rect(0, 0, layout.width_m, layout.height_m)))
    roof = table.add(Feature("roof", "roof"))
    ground = table.add(Feature("ground", "ground"))
    _body(builder, layout, wall)
    for band in layout.bands:
        feature = table.add(Feature("cornice", "band"))
        _band(builder, layout, band, feature)
    for number, opening in enumerate(layout.openings):
        name = f"{opening.class_} {opening.floor}.{opening.column}"
        feature = table.add(Feature(opening.class_, name, opening.rect))
        _opening(builder, layout, opening, opening_material(number, opening, seed), wall, feature)
        _cover(screens, opening, feature)
    for number, balcony in enumerate(layout.balconies):
        feature = table.add(Feature("balcony", f"balcony {number}", balcony.rect))
        add_balcony(builder, balcony, feature)
        add_screen(screens, balcony, feature)
    numbers = {"roof": [roof], "wall": [wall]}
    numbers["dormer"] = [
        table.add(Feature("window", f"dormer {n}", r)) for n, r in enumerate(layout.roof.dormers)
    ]
    numbers["chimney"] = [
        table.add(Feature("chimney", f"chimney {n}")) for n in range(len(layout.roof.chimneys))
    ]
    add_roof(builder, layout, lambda kind, number: numbers[kind][number])
    if street:
        add_ground(builder, ground)
    for kind, x in occluders:
        add_occluder(builder, kind, x, seed, table.add(Feature("other", kind)))
    screens.materials = builder.materials
    return BuiltFacade(
        builder.mesh(), screens.mesh(), tuple(builder.materials), looks, tuple(table.rows)
    )


class _FeatureTable:
    def __init__(self) -> None:
        self.rows: list[Feature] = []

    def add(self, feature: Feature) -> int:
        self.rows.append(feature)
        return len(self.rows) - 1


def _body(builder: MeshBuilder, layout: Layout, wall: int) -> None:
    """The street wall around its openings, and plain sides and back."""
    width, height, depth = layout.width_m, layout.height_m, layout.depth_m
    holes = [(o.rect.x_m, o.rect.y_m, o.rect.right_m, o.rect.top_m) for o in layout.openings]
    for x0, z0, x1, z1 in wall_cells((0.0, 0.0, width, height), holes):
        uv = (x0 / width, 1 - z1 / height, x1 / width, 1 - z0 / height)
        builder.quad((x0, 0, z0), (x1 - x0, 0, 0), (0, 0, z1 - z0), "wall", wall, uv)
    builder.quad((0, depth, 0), (0, -depth, 0), (0, 0, height), "side", wall)
    builder.quad((width, 0, 0), (0, depth, 0), (0, 0, height), "side", wall)
    builder.quad((width, depth, 0), (-width, 0, 0), (0, 0, height), "side", wall)


def _band(builder: MeshBuilder, layout: Layout, band: Band, feature: int) -> None:
    """A moulding in front of the wall; it stops at openings that reach through it."""
    through = [
        (o.rect.x_m, band.y_m, o.rect.right_m, band.y_m + band.height_m)
        for o in layout.openings
        if o.rect.y_m < band.y_m + band.height_m - 1e-6 and o.rect.top_m > band.y_m + 1e-6
    ]
    outer = (0.0, band.y_m, layout.width_m, band.y_m + band.height_m)
    steps = CORNICE_STEPS if band.cornice else ((0.0, 1.0, 1.0),)
    for x0, z0, x1, z1 in wall_cells(outer, through):
        for low, high, reach in steps:
            builder.box(
                (x0, -band.projection_m * reach, z0 + low * (z1 - z0)),
                (x1, 0.0, z0 + high * (z1 - z0)),
                "trim",
                feature,
                "flrtd",
            )
    if band.cornice and layout.style == "haussmann":
        _dentils(builder, layout, band, feature)


def _dentils(builder: MeshBuilder, layout: Layout, band: Band, feature: int) -> None:
    pitch = 0.42
    for i in range(int(layout.width_m / pitch)):
        x = (i + 0.5) * layout.width_m / int(layout.width_m / pitch)
        low = (x - 0.08, -0.75 * band.projection_m, band.y_m + 0.45 * band.height_m)
        builder.box(low, (x + 0.08, 0.0, band.y_m + 0.75 * band.height_m), "trim", feature, "flrd")


def _opening(
    builder: MeshBuilder, layout: Layout, opening: Opening, material: str, wall: int, feature: int
) -> None:
    """The reveal, the pane at its back, and what frames it on the wall."""
    r, back = opening.rect, layout.setback_m
    reveal = "wall" if layout.paint.wall == "brick" else "trim"
    whole = (0.02, 0.4, 0.04, 0.5)
    x0, x1, z0, z1 = r.x_m, r.right_m, r.y_m, r.top_m
    builder.quad((x0, 0, z0), (0, back, 0), (0, 0, z1 - z0), reveal, wall, whole)
    builder.quad((x1, back, z0), (0, -back, 0), (0, 0, z1 - z0), reveal, wall, whole)
    builder.quad((x0, 0, z0), (x1 - x0, 0, 0), (0, back, 0), "trim", wall)
    builder.quad((x0, back, z1), (x1 - x0, 0, 0), (0, -back, 0), reveal, wall, whole)
    builder.quad(
        (x0, back, z0), (x1 - x0, 0, 0), (0, 0, z1 - z0), material, feature, (0.0, 0.0, 1.0, 1.0)
    )
    if opening.surround:
        _surround(builder, layout, opening, wall)
    if opening.shutters:
        leaf = 0.5 * r.width_m
        for left in (x0 - leaf - 0.06, x1 + 0.06):
            builder.box((left, -0.06, z0 + 0.02), (left + leaf, -0.02, z1), "trim", wall, "lrtd")
            builder.quad(
                (left, -0.06, z0 + 0.02),
                (leaf, 0, 0),
                (0, 0, z1 - z0 - 0.02),
                "shutter",
                wall,
                (0.0, 0.0, 1.0, 1.0),
            )


def _cover(screens: MeshBuilder, opening: Opening, feature: int) -> None:
    """The opening as a flat area in the wall's plane: its reveals belong to it in label images."""
    r = opening.rect
    origin = (r.x_m, -1e-3, r.y_m)
    screens.quad(origin, (r.width_m, 0, 0), (0, 0, r.height_m), "trim", feature)


def _surround(builder: MeshBuilder, layout: Layout, opening: Opening, wall: int) -> None:
    """Sill, lintel and (on stone and stucco) an architrave."""
    r = opening.rect
    raised = r.y_m > 0.4
    if layout.style == "terrace":
        builder.box(
            (r.x_m - 0.12, -0.02, r.top_m),
            (r.right_m + 0.12, 0, r.top_m + 0.24),
            "trim",
            wall,
            "flrtd",
        )
    else:
        frame = 0.15
        for low, high in (
            ((r.x_m - frame, -0.05, r.y_m), (r.x_m, 0, r.top_m)),
            ((r.right_m, -0.05, r.y_m), (r.right_m + frame, 0, r.top_m)),
            ((r.x_m - frame, -0.05, r.top_m), (r.right_m + frame, 0, r.top_m + frame)),
        ):
            builder.box(low, high, "trim", wall, "flrtd")
        if opening.class_ == "window" and layout.style == "haussmann":
            builder.box(
                (r.x_m - 0.22, -0.16, r.top_m + frame),
                (r.right_m + 0.22, 0, r.top_m + frame + 0.09),
                "trim",
                wall,
                "flrtd",
            )
    if raised:
        builder.box(
            (r.x_m - 0.1, -0.1, r.y_m - 0.1), (r.right_m + 0.1, 0, r.y_m), "trim", wall, "flrtd"
        )
