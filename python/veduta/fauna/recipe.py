"""Reading a record of an animal: midlines, or footage; what was seen goes into the report."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta.fauna.document.coat import COAT
from veduta.fauna.document.schema import Source
from veduta.fauna.motion.angles import angles_of
from veduta.fauna.options import FaunaOptions
from veduta.fauna.pictures import angles_over_time, angles_picture, axes_picture
from veduta.fauna.read.coat import coat_from_above, coat_from_side
from veduta.fauna.read.footage import Footage, cropped, read_footage, read_masks
from veduta.fauna.read.from_side import seen_length, straight_axes
from veduta.fauna.read.limbless import Seen, axes_in, silhouettes_in, tracked_axes
from veduta.fauna.read.midlines import read_midlines
from veduta.fauna.read.overlap import drawn_body, overlap
from veduta.fauna.read.registered import CameraLooks, stilled
from veduta.fauna.read.second_silhouettes import SilhouettePictures, read_second_view
from veduta.fauna.read.second_view import SecondView
from veduta.fauna.read.side_document import describe_from_side
from veduta.fauna.read.silhouettes import frame_scores
from veduta.fauna.read.tracked import SAMPLES, Described, Tracked, describe, lengths_of
from veduta.fauna.seen_pictures import scores_picture, second_picture, silhouettes_picture
from veduta.place.material import Texture
from veduta.run.digests import file_digest
from veduta.run.errors import InputError, NotFoundError
from veduta.run.work import Work


@dataclass(frozen=True)
class Record:
    """What the user gives: the footage, perhaps masks and a background picture, and perhaps a place
    for the animal to go in, with the points of its way, a body plan
    of their own, joints that are marked already, and the colours of painted markers. second: the
    animal seen from the other side.
    """

    path: Path
    masks: Path | None = None
    background: Path | None = None
    place: Path | None = None
    way: Path | None = None
    plan: Path | None = None
    joints: Path | None = None
    markers: Path | None = None
    gaits: Path | None = None
    second: Path | None = None

    @property
    def files(self) -> tuple[Path | None, ...]:
        """All that the result depends on."""
        return (
            self.path,
            self.masks,
            self.background,
            self.place,
            self.way,
            self.plan,
            self.joints,
            self.markers,
            self.gaits,
            self.second,
        )


@dataclass(frozen=True, eq=False)
class Read:
    """What came of it; coat: None where the record shows no skin."""

    described: Described
    coat: Texture | None


def read_record(work: Work, record: Record, options: FaunaOptions) -> Read:
    """The document of the animal in the record, and its coat."""
    if record.path.suffix.lower() == ".csv":
        if options.animal.view == "side":
            fault = "has midlines, which are those of an animal that was seen from above"
            raise InputError(record.path, fault, "Leave --view out, or give the footage itself.")
        with work.step("axis") as step:
            tracked = read_midlines(record.path)
            read = Read(_described(work, record, tracked, options), None)
            step.rejected.extend(read.described.animal.source.left_out)
    else:
        read = _from_footage(work, record, options)
    _tell_axes(work, read.described)
    return read


def second_view(work: Work, record: Record) -> SecondView | None:
    """What the record has of the animal from the other side; shown in the report."""
    if record.second is None:
        return None
    with work.step("second view") as step:
        view = read_second_view(record.second, SilhouettePictures())
        step.counts["silhouettes"] = len(view.masks)
    work.picture(
        "The second view", "the first silhouette of it", second_picture(view.masks[0]), wide=True
    )
    return view


def _described(
    work: Work,
    record: Record,
    tracked: Tracked,
    options: FaunaOptions,
    areas: NDArray[np.float64] | None = None,
    scores: list[tuple[int, float]] | None = None,
) -> Described:
    """areas: (t,) of the silhouettes of an animal that is seen from the side. scores: of frames."""
    path = record.path
    source = Source(
        file=path.name,
        sha256=file_digest(path) if path.is_file() else "",
        frames=max(1, len(tracked.points) + len(tracked.left_out)),
        used=max(1, len(tracked.points)),
        scores=scores or [],
    )
    second = second_view(work, record)
    if areas is None:
        return describe(tracked, path.stem, source, options, second)
    return describe_from_side(tracked, areas, path.stem, source, options, second)


def still_footage(work: Work, record: Record, options: FaunaOptions) -> Footage:
    """The frames as of a camera that stands still, on a canvas where it moved."""
    with work.step("frames") as step:
        footage = read_footage(record.path, options.footage.fps)
        footage = cropped(footage, options.footage.crop, record.path.name)
        step.counts["frames"] = len(footage.frames)
    if footage.assumed:
        work.doubt(
            f"nothing tells how fast the frames follow: {1.0 / footage.frame_s:g} a second were"
            " assumed (--fps)"
        )
    if record.background is not None:
        return footage
    animal = None if record.masks is None else read_masks(record.masks, footage)
    with work.step("camera") as step:
        try:
            still = stilled(footage, CameraLooks(), record.path.name, animal)
        except NotFoundError as error:
            if animal is None:
                raise
            # Silhouettes alone do for the animal's shape.
            work.doubt(
                f"how the camera moved was not found ({error.evidence}): the animal's way is"
                " that in the pictures"
            )
            return footage
        step.counts["moves"] = int(still is not footage)
    return still


def _from_footage(work: Work, record: Record, options: FaunaOptions) -> Read:
    footage = still_footage(work, record, options)
    with work.step("silhouettes") as step:
        found, background = silhouettes_in(
            footage, record.masks, record.background, record.path.name
        )
        step.counts["good"] = len(found.rows)
        step.rejected.extend(f"frame {footage.number[row]}: {why}" for row, why in found.left_out)
    if background is not None and background.filled > 0.0:
        work.note(
            f"{background.filled:.2%} of the background is never seen: the animal stays there, and"
            " it was filled from around"
        )
    with work.step("axis") as step:
        axes = axes_in(found) if _bends(options) else straight_axes(found.masks)
        seen = Seen(found, axes, background)
        tracked = tracked_axes(footage, seen)
        areas = _areas(footage, seen, tracked) if options.animal.view == "side" else None
        scores = frame_scores(found, footage.number)
        described = _described(work, record, tracked, options, areas, scores)
        step.counts["used"] = described.animal.source.used
    with work.step("coat"):
        read = _with_coat(footage, described)
    _tell_silhouettes(work, footage, seen, read.described)
    tell_scores(work, scores)
    return read


def tell_scores(work: Work, scores: list[tuple[int, float]]) -> None:
    """How sure the silhouette in each frame is."""
    work.measure("silhouette_score_worst", min(score for _, score in scores))
    work.picture(
        "How sure each silhouette is",
        f"frames {scores[0][0]} to {scores[-1][0]}: a bar of full height is as large as in the"
        " others, with nothing else beside it; a gap is a frame that was left out",
        scores_picture(scores),
        wide=True,
    )


def _bends(options: FaunaOptions) -> bool:
    """Whether what is seen bends: a fish from the side is straight."""
    return options.animal.kind != "fish" or options.animal.view != "side"


def _areas(footage: Footage, seen: Seen, tracked: Tracked) -> NDArray[np.float64]:
    """(t,) px of the silhouettes whose axes were found."""
    chosen = np.isin(footage.number[seen.silhouettes.rows], tracked.frame)
    return np.asarray(seen.silhouettes.masks[chosen].sum(axis=(1, 2)), dtype=np.float64)


def _with_coat(footage: Footage, described: Described) -> Read:
    """The footage's colours; the document names them."""
    animal, tracked = described.animal, described.tracked
    rows = np.searchsorted(footage.number, tracked.frame)
    points, half = _in_pixels(footage, described)
    frames = footage.frames[rows]
    if described.looks_right is None:
        coat = coat_from_above(frames, points, half)
    else:
        coat = coat_from_side(frames, points, half, described.looks_right)
    body = animal.body.model_copy(update={"coat": COAT})
    return Read(replace(described, animal=animal.model_copy(update={"body": body})), coat)


def _in_pixels(
    footage: Footage, described: Described
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """(t, n, 2) the axes, y down, and (n,) half of how thick the body is along them as seen."""
    points = described.tracked.points.copy()
    points[..., 1] = footage.size[0] - points[..., 1]
    slices = described.animal.body.slices
    along = np.linspace(0.0, 1.0, points.shape[1])
    thick = [piece.half_height if described.from_side else piece.half_width for piece in slices]
    share = np.interp(along, [piece.at for piece in slices], thick)
    if described.from_side:
        return points, share * seen_length(described.tracked)
    return points, share * float(np.median(lengths_of(points)))


def _tell_silhouettes(work: Work, footage: Footage, seen: Seen, described: Described) -> None:
    points, half = _in_pixels(footage, described)
    rows = np.searchsorted(footage.number, described.tracked.frame)
    place = {int(row): number for number, row in enumerate(seen.silhouettes.rows)}
    scores = [
        overlap(drawn_body(line, half, footage.size), seen.silhouettes.masks[place[int(row)]])
        for line, row in zip(points, rows, strict=True)
    ]
    work.measure("silhouette_iou_median", float(np.median(scores)))
    work.measure("silhouette_iou_worst", float(np.min(scores)))
    work.picture(
        "Silhouettes and their axis",
        "six of the good frames: the silhouette's outline (red), the axis (green), its head (dot)",
        silhouettes_picture(footage, seen, points, rows),
        wide=True,
    )


def _tell_axes(work: Work, described: Described) -> None:
    """Figure 11 for this animal."""
    work.picture(
        "The axis through the footage",
        "early frames blue, late ones red; a dot at the head",
        axes_picture(described.axes),
        wide=True,
    )
    if described.from_side:
        return  # its angles are those of its kind
    again = angles_of(described.states, SAMPLES)
    middle = len(again) // 2
    work.picture(
        "The angle of the axis",
        "A(s) from head to tail in a frame in the middle (blue), and what the seven Fourier"
        " coefficients of its state keep of it (black)",
        angles_picture(described.angles[middle], again[middle]),
        wide=True,
    )
    work.picture(
        "The angles through time",
        "time to the right, the head at the top; a wave that runs down the body is a slanted band",
        angles_over_time(described.angles),
        wide=True,
    )
