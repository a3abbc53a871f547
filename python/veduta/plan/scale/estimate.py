"""The scale of a sheet from all that is written and drawn on it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from veduta.plan.document import Scale, ScaleEvidence, Text
from veduta.plan.scale.assumed import DOOR_M, assumed_scale, door_voter
from veduta.plan.scale.bars import bar_voters
from veduta.plan.scale.dimension_lines import line_voters
from veduta.plan.scale.evidence import Voter
from veduta.plan.scale.free_runs import wall_masks
from veduta.plan.scale.marks import without_marks
from veduta.plan.scale.plausible import limits_of, plausible
from veduta.plan.scale.ratios import ratio_voters
from veduta.plan.scale.room_sizes import of_house, room_voters
from veduta.plan.scale.sharpen import Reading, sharpened
from veduta.plan.scale.side_readings import side_readings
from veduta.plan.scale.vote import take_vote
from veduta.plan.scale.width_rule import width_rule_voters
from veduta.run.errors import InputError

_OF_BAR = 0.3  # of full ink; the edges of a bar's white parts are thin
_BLUR_PX = 0.7  # how exactly faces of walls are found
_RIVAL = 0.5  # a second group with so many of the votes is told of
_DOUBT_SIGMA = 0.1
_ALONE_SIGMA = 0.03
GIVEN_SIGMA = 0.001
_EXACT = ("line", "bar")  # what else says the scale to a pixel
_DISAGREES = 0.03  # a given scale that differs so much from the sheet's own is told of

_MANY_LINES, _STRAY_LINE = 4, 0.2  # so many agree; natural logarithm of how far others stray


@dataclass(frozen=True)
class DrawnSizes:
    """What the drawing shows, in pixels of the cleaned image.

    `rooms` are outlines (n, 2); `doors` widths of openings for doors; `walls` thicknesses; `ink`
    (h, w), 0 paper to 1 ink; `dpi` the resolution that the file states, None where it does not;
    `on_paper` whether it is that of a page of known size.
    """

    rooms: Sequence[NDArray[np.float64]]
    doors: Sequence[float]
    walls: Sequence[float]
    ink: NDArray[np.float32]
    dpi: float | None = None
    on_paper: bool = False
    texts: Sequence[Text] = field(default=())

    @cached_property
    def sayings(self) -> list[Text]:
        """The texts without marks of doors and windows."""
        return without_marks(self.texts)

    @cached_property
    def masks(self) -> tuple[NDArray[np.uint8], ...]:
        """(h, w) of walls, as `free_runs` asks for them."""
        return wall_masks(self.ink, self.walls)


def estimate_scale(
    sizes: DrawnSizes, given: float | None = None, beside: Sequence[DrawnSizes] = ()
) -> Scale:
    """The scale by the vote of all evidence; `given` (metres per pixel) goes before it.

    `beside`: what other storeys on the same sheet show, whose pixels are as large. Without any
    evidence it is assumed from doors, else walls, else the size of the drawing, and
    its basis says so. Raises `InputError` where `given` is no size of a pixel.
    """
    if given is not None and not 1e-6 < given < 10.0:
        raise InputError("--scale", f"{given} m is no size of a pixel", "Give 0.000001 to 10 m.")
    every = [sizes, *beside]
    voters = [one for part in every for one in find_voters(part)]
    if given is not None:
        return _given(given, voters)
    sizes = together(every)
    found, voters = voters, plausible(voters, limits_of(sizes))
    absurd = _set_aside(found, voters)
    doors = door_voter(sizes.doors)
    if not voters:
        assumed = _assumed(doors, sizes)
        return assumed.model_copy(update={"evidence": [*assumed.evidence, *absurd]})
    told = _voted([*voters, doors] if doors else voters)
    told = told.model_copy(update={"evidence": [*told.evidence, *absurd]})
    if any(one.agrees and one.kind != "door" for one in told.evidence):
        return _sharpened(told, every)
    # Doors outvote a lone number that means something else; but they are an assumption.
    assumed = _assumed(doors, sizes)
    others = [
        one.model_copy(update={"agrees": False}) for one in told.evidence if one.kind != "door"
    ]
    return assumed.model_copy(update={"evidence": [*assumed.evidence, *others]})


def _set_aside(found: Sequence[Voter], kept: Sequence[Voter]) -> list[ScaleEvidence]:
    """What has no plausible reading, as evidence that disagrees, by its likeliest reading."""
    names = {(one.place, one.text) for one in kept}
    evidence = []
    for voter in found:
        if (voter.place, voter.text) not in names:
            best = max(voter.hypotheses, key=lambda one: one.trust)
            size = float(np.exp(best.log_mpp))
            evidence.append(
                ScaleEvidence(
                    kind=voter.kind,
                    text=voter.text,
                    metres_per_px=size,
                    sigma=best.sigma,
                    agrees=False,
                )
            )
    return evidence


def find_voters(sizes: DrawnSizes) -> list[Voter]:
    """All that the sheet says of its scale."""
    texts, rooms = sizes.sayings, list(sizes.rooms)
    return [
        *room_voters(texts, rooms, _BLUR_PX, sizes.masks),
        *line_voters(texts, sizes.ink, _BLUR_PX),
        *bar_voters(texts, sizes.ink > _OF_BAR),
        *ratio_voters(texts, sizes.dpi, on_paper=sizes.on_paper),
        *width_rule_voters(texts, rooms, sizes.ink),
    ]


def scale_notes(scale: Scale) -> list[str]:
    """What a reader must know of a scale: that it was assumed, or that evidence disagrees."""
    notes = []
    if scale.basis == "assumed":
        # Of a document that was edited, the evidence may be gone.
        by = f"{scale.evidence[0].text}: sizes" if scale.evidence else "Sizes"
        notes.append(
            f"Nothing on the sheet says its scale. {by} may be wrong by"
            f" {200 * scale.sigma:.0f} %. --scale sets it."
        )
    # What is written as the whole house's area need not be this storey's; where many lines agree,
    # a number that fits none of its lines by far is a number of something else.
    lines = sum(one.agrees for one in scale.evidence if one.kind == "line")
    against = [
        one
        for one in scale.evidence
        if not one.agrees
        and one.kind != "door"
        and not of_house(one.text)
        and not (
            one.kind == "line"
            and lines >= _MANY_LINES
            and abs(math.log(one.metres_per_px / scale.metres_per_px)) > _STRAY_LINE
        )
    ]
    said = [one for one in scale.evidence if one.kind != "door"]
    if against:
        named = "; ".join(
            f"{one.text} ({100 * (one.metres_per_px / scale.metres_per_px - 1):+.1f} %)"
            for one in against[:5]
        )
        notes.append(f"{len(against)} of {len(said)} sizes on the sheet disagree: {named}.")
    return notes


def _voted(voters: list[Voter]) -> Scale:
    verdict = take_vote(voters)
    evidence = [
        ScaleEvidence(
            kind=voter.kind,
            text=voter.text,
            metres_per_px=float(np.exp(chosen.log_mpp)),
            sigma=chosen.sigma,
            agrees=agrees,
        )
        for voter, chosen, agrees in zip(voters, verdict.chosen, verdict.agrees, strict=True)
    ]
    alike = {
        voter.place
        for voter, agrees in zip(voters, verdict.agrees, strict=True)
        if agrees and voter.kind != "door"
    }
    # Two scales with much the same support: which of them it is, is not known. What only one thing
    # on the sheet says may have been read or measured wrong without a trace.
    doubt = verdict.rival_mpp is not None and verdict.rival_share >= _RIVAL
    least = _DOUBT_SIGMA if doubt else (_ALONE_SIGMA if len(alike) < 2 else 0.0)
    return Scale(
        metres_per_px=verdict.metres_per_px,
        sigma=max(verdict.sigma, least),
        basis="evidence",
        evidence=evidence,
    )


def together(every: Sequence[DrawnSizes]) -> DrawnSizes:
    """What storeys on one sheet (or on sheets whose pixels are as large) show, as if one."""
    if len(every) == 1:
        return every[0]
    return replace(
        every[0],
        rooms=[room for one in every for room in one.rooms],
        doors=[door for one in every for door in one.doors],
        walls=[wall for one in every for wall in one.walls],
        texts=[text for one in every for text in one.texts],
        ink=_all_ink([one.ink for one in every]),
    )


def _all_ink(every: Sequence[NDArray[np.float32]]) -> NDArray[np.float32]:
    """The ink of all sheets on one that is as large as each of them."""
    whole = np.zeros(np.max([one.shape for one in every], axis=0), np.float32)
    for one in every:
        part = whole[: one.shape[0], : one.shape[1]]
        np.maximum(part, one, out=part)
    return whole


def _sharpened(told: Scale, every: Sequence[DrawnSizes]) -> Scale:
    """The scale of the vote, by each side of a room and each line as exactly as it is measured."""
    readings = [
        *(
            reading
            for sizes in every
            for reading in side_readings(
                sizes.sayings, sizes.rooms, sizes.walls, sizes.masks, sizes.ink, told.metres_per_px
            )
        ),
        *(
            Reading(math.log(one.metres_per_px), one.sigma, 1.0, 0.0)
            for one in told.evidence
            if one.kind in _EXACT and one.agrees
        ),
    ]
    return told.model_copy(update={"metres_per_px": sharpened(told.metres_per_px, readings)})


def _given(metres_per_px: float, voters: list[Voter]) -> Scale:
    own = _voted(voters).evidence if voters else []
    first = ScaleEvidence(kind="given", metres_per_px=metres_per_px, sigma=GIVEN_SIGMA, agrees=True)
    judged = judged_by(metres_per_px, own)
    return Scale(
        metres_per_px=metres_per_px, sigma=GIVEN_SIGMA, basis="given", evidence=[first, *judged]
    )


def judged_by(metres_per_px: float, evidence: Sequence[ScaleEvidence]) -> list[ScaleEvidence]:
    """The evidence with whether it agrees with a scale that is known."""
    return [
        one.model_copy(
            update={
                "agrees": abs(one.metres_per_px / metres_per_px - 1.0)
                <= max(3.0 * one.sigma, _DISAGREES)
            }
        )
        for one in evidence
    ]


def _assumed(doors: Voter | None, sizes: DrawnSizes) -> Scale:
    if doors is not None:
        reading = doors.hypotheses[0]
        evidence = ScaleEvidence(
            kind="door",
            text=f"{doors.text}, taken for {DOOR_M} m",
            metres_per_px=float(np.exp(reading.log_mpp)),
            sigma=reading.sigma,
            agrees=True,
        )
    else:
        evidence = assumed_scale(sizes.walls, _extent(sizes.ink))
    return Scale(
        metres_per_px=evidence.metres_per_px,
        sigma=evidence.sigma,
        basis="assumed",
        evidence=[evidence],
    )


def _extent(ink: NDArray[np.float32]) -> float:
    """Long side of the rectangle around all ink, in pixels; of the sheet where it is blank."""
    rows, columns = np.nonzero(ink.max(axis=1) > 0.5)[0], np.nonzero(ink.max(axis=0) > 0.5)[0]
    if not len(rows):
        return float(max(ink.shape))
    return float(max(np.ptp(rows), np.ptp(columns)) + 1)
