"""Reading footage of an animal with limbs; what was seen goes into the report."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.fauna.document.coat import COAT
from veduta.fauna.document.limbed import LimbedAnimal
from veduta.fauna.document.plan import BodyPlan, load_plan
from veduta.fauna.document.schema import Source
from veduta.fauna.limbed_pictures import chart_picture, figures_picture
from veduta.fauna.motion.figure import Floats, figure_of
from veduta.fauna.options import FaunaOptions
from veduta.fauna.pins_recipe import pins_of
from veduta.fauna.read.drawn import drawn_figure
from veduta.fauna.read.footage import Footage
from veduta.fauna.read.limbed import LimbedLooks, LimbedSeen, fit_limbed
from veduta.fauna.read.limbed_coat import coat_of_plane
from veduta.fauna.read.limbed_document import described_limbs, scaled_animal, with_second_view
from veduta.fauna.read.limbless import silhouettes_in
from veduta.fauna.read.overlap import overlap
from veduta.fauna.read.silhouettes import Silhouettes, frame_scores
from veduta.fauna.read.ways import WayLooks, stretches_of
from veduta.fauna.recipe import Record, second_view, still_footage, tell_scores
from veduta.place.material import Texture
from veduta.run.digests import file_digest
from veduta.run.errors import InputError, NotFoundError
from veduta.run.work import Work

_MOST_FRAMES = 72
"""More are not fitted: a cycle is in them many times over."""
_FEWEST_FRAMES = 5
_TURNS = "it turns round there, and one plane does not hold it"
_FEW = "it is kept, as too few that show it whole are left beside the turn"
_MORE = "more frames than are fitted, and others are in the middle or show it whole"
_CUT = "the frame's border cuts the animal; it is fitted from what is seen of it"


@dataclass(frozen=True, eq=False)
class ReadLimbed:
    """The document of an animal with limbs, and its coat."""

    animal: LimbedAnimal
    coat: Texture


def plan_for(record: Record, options: FaunaOptions) -> BodyPlan:
    """The body plan that a record is read by; InputError where its view is another one."""
    plan = load_plan(options.animal.kind, record.plan)
    view = options.animal.view
    if view not in ("auto", plan.view):
        raise InputError(
            record.path,
            f"is to be seen from the {view}, but the body plan {plan.name} is one from the"
            f" {plan.view}",
            "Give a body plan of that view (--plan); docs/fauna.md says how to write one.",
        )
    return plan


def read_limbed(work: Work, record: Record, options: FaunaOptions) -> ReadLimbed:
    """The document of the animal in footage, and its coat."""
    plan = plan_for(record, options)
    footage = still_footage(work, record, options)
    with work.step("silhouettes") as step:
        found, _ = silhouettes_in(
            footage, record.masks, record.background, record.path.name, with_cut=True
        )
        step.counts["good"] = len(found.rows)
        left_out = [f"frame {footage.number[row]}: {why}" for row, why in found.left_out]
        step.rejected.extend(left_out)
        found, more = fewer(found)
        told = [f"frame {footage.number[row]}: {_MORE}" for row in more]
        step.rejected.extend(told)
        left_out.extend(told)
    pins = pins_of(work, record, footage, found, plan, options.footage)
    found, ways, cut = parted(work, footage, found, plan, left_out, pins.trust)
    with work.step("figure") as step:
        step.rejected.extend(f"frame {number}: {_CUT}" for number in cut)
        seen = fit_limbed(
            found.masks, footage.number[found.rows], plan, LimbedLooks(),
            lambda: work.progress("figure", 0.5),
            {name: places[found.rows] for name, places in pins.px.items()},
            footage.frames[found.rows],
            {name: trust[found.rows] for name, trust in pins.trust.items()}, found.shown(),
            ways,
        )  # fmt: skip
        step.counts["segments"] = len(seen.fitted.figure.start)
    joints = seen.windows.in_picture(seen.fitted.joints(), seen.fitted.px_per_length)
    overlaps = _overlaps(seen, found, joints)
    source = Source(
        file=record.path.name,
        sha256=file_digest(record.path) if record.path.is_file() else "",
        frames=len(footage.frames),
        used=len(found.rows),
        left_out=left_out,
        cut=cut,
        scores=frame_scores(found, footage.number),
    )
    with work.step("gait") as step:
        animal = described_limbs(seen, plan, record.path.stem, source, footage.frame_s, overlaps,
                                 options)  # fmt: skip
        step.counts["gaits"] = len(animal.gaits)
    if (second := second_view(work, record)) is not None:
        animal = with_second_view(animal, second)
    with work.step("coat"):
        coat = _coat(footage, found, seen, plan, joints)
    _tell(work, footage, found, seen, joints, overlaps, animal)
    tell_scores(work, source.scores)
    return ReadLimbed(animal.model_copy(update={"coat": COAT}), coat)


def fewer(found: Silhouettes) -> tuple[Silhouettes, NDArray[np.int64]]:
    """Those that are fitted if there are many, and the rows of the others: the middle ones of those
    that show it whole, or all these and the cut ones nearest to them; NotFoundError where too few
    show it whole.
    """
    every = np.arange(len(found.rows))
    whole = every if found.cut is None else np.flatnonzero(~found.cut)
    if len(whole) < _FEWEST_FRAMES:
        raise NotFoundError(
            "the animal's motion",
            f"only {len(whole)} frames show it whole",
            f"Give footage in which at least {_FEWEST_FRAMES} frames do.",
        )
    if len(whole) >= _MOST_FRAMES:
        first = (len(whole) - _MOST_FRAMES) // 2
        kept = whole[first : first + _MOST_FRAMES]
    else:
        away = np.abs(found.rows[:, None] - found.rows[whole]).min(axis=1)
        kept = np.sort(np.argsort(away, kind="stable")[:_MOST_FRAMES])
    return found.of(kept), found.rows[np.setdiff1d(every, kept)]


def parted(
    work: Work, footage: Footage, found: Silhouettes, plan: BodyPlan, left_out: list[str],
    trust: Mapping[str, Floats],
) -> tuple[Silhouettes, Floats | None, list[int]]:  # fmt: skip
    """The silhouettes to fit, (t,) which way it looks in each, and the numbers of those that the
    border cuts. What is left out joins left_out.
    """
    found, ways = _turned(work, footage, found, plan, left_out, trust)
    # Of those that are left: one that is cut may turn round, too.
    cut = [] if found.cut is None else [int(n) for n in footage.number[found.rows[found.cut]]]
    return found, ways, cut


def _turned(
    work: Work, footage: Footage, found: Silhouettes, plan: BodyPlan, left_out: list[str],
    trust: Mapping[str, Floats],
) -> tuple[Silhouettes, Floats | None]:  # fmt: skip
    """The silhouettes of an animal that turns round without those in which it does, and (t,) which
    way it looks in each; None where it does not turn, marks alone hold it, or too little is left.
    trust: (t,) by joint in all frames, of marks.
    """
    if plan.view == "top":
        return found, None
    own = {name: sure[found.rows] for name, sure in trust.items()}
    stretches = stretches_of(found, footage.frames[found.rows], WayLooks(), own)
    if not stretches.turning.any():
        return found, None
    with work.step("turns round") as step:
        numbers = footage.number[found.rows[stretches.turning]]
        step.counts["frames"] = len(numbers)
        if stretches.right is None:
            why = ": the marks do" if not stretches.few else f"; {_FEW}"
            step.rejected.extend(f"frame {number}: {_TURNS}{why}" for number in numbers)
            return found, None
        told = [f"frame {number}: {_TURNS}; it is left out" for number in numbers]
        step.rejected.extend(told)
        left_out.extend(told)
        work.note("the animal turns round: the frames on either side of that are used")
    kept = np.flatnonzero(~stretches.turning)
    return found.of(kept), stretches.right[kept]


def _overlaps(seen: LimbedSeen, found: Silhouettes, joints: Floats) -> Floats:
    fitted = seen.fitted
    deep = fitted.deep * fitted.px_per_length
    shape = (int(found.masks.shape[1]), int(found.masks.shape[2]))
    return np.array(
        [
            overlap(drawn_figure(fitted.figure, at, deep, shape), mask)
            for at, mask in zip(joints, found.masks, strict=True)
        ]
    )


def _coat(
    footage: Footage, found: Silhouettes, seen: LimbedSeen, plan: BodyPlan, joints: Floats
) -> Texture:
    scaled = scaled_animal(seen, plan, footage.frame_s)
    ways = seen.windows.ways()
    # Of one that turns round the side that is seen for longer.
    way = 1.0 if ways.sum() > 0.0 else -1.0
    rows = np.flatnonzero(ways == way)
    return coat_of_plane(
        footage.frames[found.rows[rows]], found.masks[rows], figure_of(scaled.plan),
        scaled.turns[rows], joints[rows], scaled.unit_px, way, top=plan.view == "top",
    )  # fmt: skip


def _tell(
    work: Work, footage: Footage, found: Silhouettes, seen: LimbedSeen, joints: Floats,
    overlaps: Floats, animal: LimbedAnimal,
) -> None:  # fmt: skip
    work.measure("silhouette_iou_median", float(np.median(overlaps)))
    work.measure("silhouette_iou_worst", float(np.min(overlaps)))
    for gait in animal.gaits:
        work.measure("cycle_s", gait.cycle_s)
        work.measure("stride_lengths", gait.stride)
    work.picture(
        "The figure in the silhouettes",
        "six of the frames: the silhouette's outline green, left limbs blue, right ones red",
        figures_picture(footage.frames[found.rows], found.masks, seen.fitted.figure, joints),
        wide=True,
    )
    if animal.poses.feet:
        work.picture(
            "Which feet stand",
            "a bar for each frame in which a foot is on the ground (figure 13 of the paper)",
            chart_picture(animal),
            wide=True,
        )
