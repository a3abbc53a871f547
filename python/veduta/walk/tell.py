"""What a walk tells of itself: its document, and its report."""

from __future__ import annotations

import numpy as np

from veduta.run.page import Table
from veduta.run.work import Work
from veduta.walk.build.level import Gains
from veduta.walk.build.place import Station
from veduta.walk.build.way import Way
from veduta.walk.document.schema import (
    KeyRecord,
    RigRecord,
    TransitionRecord,
    ViewRecord,
    WalkDocument,
)
from veduta.walk.keys import KeyFigures
from veduta.walk.rig import Image, PairFiles, Rig

Cell = float | int | str | None
UNITS = {True: "m", False: "frame steps"}
"""Of lengths, by whether they are in metres."""
COLUMNS = (
    "from, to", "kind", "Psi", "predicted dB", "unmoved dB", "energy", "by ICM", "bound",
)  # fmt: skip
MUCH_MOVES = 0.15
"""Of a view: more is rarely a thing that moves, and often a wrong depth."""
NOTE = (
    "Psi: share of the picture in which the two views were found to show the same. Predicted and"
    " unmoved: how near the next view is to its prediction, and to the view before it as it is"
    " (PSNR). Energy: of the labels that say what goes where, beside what a simpler search (ICM)"
    " finds, and the least that there can be."
)


def document_of(
    rig: Rig, keys: list[tuple[PairFiles, ...]], figures: list[KeyFigures], stations: list[Station],
    gains: Gains, ends: list[tuple[int, int]], ways: list[Way],
    models: list[tuple[str, str] | None], *, in_metres: bool = True,
) -> WalkDocument:  # fmt: skip
    """`walk.json` of a walk. ends: the numbers of the key positions of each way; models: files."""
    return WalkDocument(
        scale="metres" if in_metres else "unknown",
        rig=RigRecord(
            width_px=rig.width_px, height_px=rig.height_px, focal_px=rig.focal_px,
            centre_px=rig.centre_px, baseline_m=rig.baseline_m,
            centre_right_px=rig.centre_px[0] - rig.shift_px,
        ),
        keys=[_key(*one) for one in zip(keys, figures, stations, gains, strict=True)],
        transitions=[
            _transition(way, stations[start].id, stations[end].id, files)
            for way, (start, end), files in zip(ways, ends, models, strict=True)
        ],
    )  # fmt: skip


def _key(views: tuple[PairFiles, ...], key: KeyFigures, station: Station, gain: Gains) -> KeyRecord:
    front = views[key.front]
    shown = [
        ViewRecord(
            id=one.view, left=one.left.name, right=one.right.name,
            turn=tuple(turn.ravel().tolist()) if np.isfinite(turn).all() else None,
        )
        for one, turn in zip(views, key.turns, strict=True)
    ]  # fmt: skip
    return KeyRecord(
        id=station.id, left=front.left.name, right=front.right.name,
        transform=tuple(station.world_from_camera.T.ravel().tolist()),
        gain=(float(gain[0]), float(gain[1]), float(gain[2])),
        views=tuple(shown) if len(views) > 1 else (), water=key.water, grass=key.grass,
    )  # fmt: skip


def _transition(way: Way, start: str, end: str, models: tuple[str, str] | None) -> TransitionRecord:
    forth, back = models or (None, None)
    verdict = way.verdict
    energies = way.energies or (None, None, None)
    return TransitionRecord(
        start=start, end=end, kind=way.kind, why=way.why, matches=way.matches,
        distance_m=None if verdict is None else way.distance_m,
        residual_px=way.residual_px, psi=None if verdict is None else verdict.psi,
        score_db=None if verdict is None else verdict.score_db,
        unmoved_db=None if verdict is None else verdict.unmoved_db, moving=way.moving[0],
        energy=energies[0], energy_icm=energies[1], energy_bound=energies[2],
        forth=forth, back=back,
    )  # fmt: skip


def tell_walk(
    work: Work, stations: list[Station], ends: list[tuple[int, int]], ways: list[Way], *,
    in_metres: bool = True,
) -> None:  # fmt: skip
    """The report: measures, a table of the transitions, and what is doubtful.

    in_metres: whether the walk's scale is known.
    """
    unit = UNITS[in_metres]
    kinds = [way.kind for way in ways]
    steps = [way.distance_m for way in ways if way.forth]
    work.measure("key_positions", len(stations))
    work.measure("length_m" if in_metres else "length_frame_steps", sum(steps))
    for kind in ("morph", "fade", "cut"):
        work.measure(f"transitions_{kind}", kinds.count(kind))
    rows: list[list[Cell]] = []
    for (start, end), way in zip(ends, ways, strict=True):
        names = f"{stations[start].id} to {stations[end].id}"
        if way.why:
            work.doubt(f"{names}: {'a cut' if way.kind == 'cut' else 'cross-faded'}: {way.why}")
        if way.predicted is not None and way.kind != "morph":
            work.picture(names, f"the view of {stations[end].id} as predicted", way.predicted)
        if way.beside is not None:
            work.picture(
                f"{names}, a cut", "both views, which have too little in common", way.beside
            )
        if max(way.moving) > 0.0:
            _tell_moving(work, names, way)
        rows.append([names, way.kind, *_figures(way)])
    columns = [*COLUMNS[:2], unit, *COLUMNS[2:]]
    work.table(Table("Transitions", columns, rows, note=NOTE))
    _best_picture(work, ways)
    work.file("walk.json", "the key positions and transitions, each with its score")
    work.file("place.json", "the place that `veduta view` shows")
    work.file("points.ply", "what stereo measured near the key positions")
    work.file("walk/key-*.webp", "what each key position shows")
    if any(way.forth is not None for way in ways):
        work.file("walk/way-*.glb", "the models of both ends of each transition that is no cut")
    work.summary = (
        f"{len(stations)} key positions, {sum(steps):.1f} {unit}: {kinds.count('morph')}"
        f" transitions morph, {kinds.count('fade')} cross-fade, {kinds.count('cut')} are cut"
    )


def moving_or_wrong(there: float, gone: float) -> str:
    """What two views contradict each other by; there, gone: shares of both that seem to move."""
    if max(there, gone) > MUCH_MOVES:
        return "something moves, or a depth of one of them is wrong"
    return "something moves"


def _tell_moving(work: Work, names: str, way: Way) -> None:
    there, gone = way.moving
    work.doubt(
        f"{names}: {moving_or_wrong(there, gone)}, in {there:.1%} of the one view and"
        f" {gone:.1%} of the other: it is shown where each took it, and left out between"
    )
    if way.shown is not None:
        work.picture(f"What moves, {names}", "red: not there any more in the next view", way.shown)


def tell_marks(
    work: Work, figures: list[KeyFigures], stations: list[Station],
    marked: tuple[float, str, Image] | None,
) -> None:  # fmt: skip
    """Where water and grass are seen. marked: the view with most of them, their share and name."""
    for name in ("water", "grass"):
        shares = {one.id: getattr(key, name) for one, key in zip(stations, figures, strict=True)}
        seen = {key: share for key, share in shares.items() if share > 0.0}
        work.measure(f"largest_{name}_share", max(shares.values()))
        if seen:
            most = max(seen, key=lambda key: seen[key])
            work.note(
                f"{name} is seen from {len(seen)} of {len(shares)} key positions, most of it from"
                f" {most} ({seen[most]:.0%} of the view)"
            )
    if marked is not None:
        work.picture(f"Water and grass, {marked[1]}", "blue: still water; green: grass", marked[2])


def _figures(way: Way) -> list[Cell]:
    verdict = way.verdict
    judged: list[Cell] = [None] * 4
    if verdict is not None:
        judged = [
            round(way.distance_m, 2), f"{verdict.psi:.0%}",
            round(verdict.score_db, 1), round(verdict.unmoved_db, 1),
        ]  # fmt: skip
    return judged + ([None] * 3 if way.energies is None else [round(one) for one in way.energies])


def _best_picture(work: Work, ways: list[Way]) -> None:
    best = max(
        (way for way in ways if way.predicted is not None),
        key=lambda way: way.verdict.score_db if way.verdict else 0.0,
        default=None,
    )
    if best is not None and best.predicted is not None:
        work.picture(
            "The next view, predicted",
            "from the colours of the one before it alone: dark is what that one did not see, which"
            " the walk takes from the other view",
            best.predicted,
        )
