"""Whether the level coordinates of control points are the other way round: north before east."""

from __future__ import annotations

from veduta.photos.structure import Structure
from veduta.photos.world.control_file import ControlPoints
from veduta.photos.world.control_fit import control_georeference


def settled_axes(structure: Structure, control: ControlPoints) -> tuple[ControlPoints, str]:
    """The points as the photos speak for them, and what is to be told; the text may be empty.

    Only where they contradict each other as they are, and agree the other way round.
    """
    if control.exchanged is None or control_georeference(structure, control).accepted:
        return control, ""
    other = control_georeference(structure, control.exchanged)
    if not other.accepted:
        return control, ""
    note = (
        f"the first two coordinates of {control.path.name} are exchanged (latitude or north comes"
        " first): the points contradict each other as they are written, and agree the other way"
        " round, so they were read so"
    )
    return control.exchanged, note
