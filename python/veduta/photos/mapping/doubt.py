"""Doubtful pairs: photos that match, but that cannot show the same place.

Symmetric and repeated facades match across sides. Where photos of a model contradict each other
(`conflicts`), the pairs that agree are trusted, what trusted pairs confirm is trusted with them
(`votes`), and of the other pairs of such photos none is mapped with. Where no photos contradict
each other nothing is dropped.
"""

from __future__ import annotations

import json
import shutil
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np
import pycolmap

from veduta.photos.mapping.conflicts import ClosePair
from veduta.photos.mapping.repeated import there_once
from veduta.photos.mapping.votes import Matched, Pair, Vote, chain, vote
from veduta.run.atomic import atomic_write, write_bytes

CONFLICT = 0.15
"""Share of the cells from which on two close photos contradict each other. Rendered buildings with
four equal sides: false pairs 0.18 to 0.46, true ones at most 0.12; fountain-P11: 0."""
FEWEST_CONFLICTS = 5
"""Cells that must conflict, besides."""
AGREE = 0.1
"""Share up to which two close photos agree."""
CONFIRMED = 10
"""Matches that trusted pairs must confirm for a pair to be trusted."""
OVERRULED = 3.0
"""So many times as many must be confirmed as contradicted."""
STRONGER = 1.1
"""So many times as many features as any false pair of a photo has must agree in a pair that nothing
confirms."""
ROUNDS = 10
"""Times that newly trusted pairs are asked, too."""


@dataclass(frozen=True)
class Doubt:
    """A pair of photos (image ids) that is not mapped with, how many features agree, and why."""

    first: int
    second: int
    verified: int
    reason: str


def doubtful_pairs(
    close: Sequence[ClosePair],
    matched: Matched,
    earlier: Sequence[Doubt] = (),
    apart: frozenset[Pair] = frozenset(),
) -> tuple[Doubt, ...]:
    """The pairs to drop, with those that were dropped earlier.

    close: of the model that was made without those. apart: those of them that stand in one place
    and show different ones; where some do that were dropped, others still hold them together.
    Where no others of its photos contradict each other there are no more.
    """
    known = {(doubt.first, doubt.second): doubt for doubt in earlier}
    torn = {pair.ids: pair for pair in close if contradict(pair) or pair.ids in apart}
    torn = {pair: torn[pair] for pair in torn if pair in matched.matches and pair not in known}
    if not torn and not apart:
        return tuple(earlier)
    apart |= {pair for pair, doubt in known.items() if doubt.reason == _APART}
    once = there_once(matched, apart) if apart else {}
    sure = {pair for pair in once if once[pair].shows_one_place} - {*known} - apart
    ambiguous = {pair for pair in once if once[pair].is_ambiguous}
    # What nothing repeats in was not compared with what is around: it is as torn as before.
    repeats = {pair for pair in sure if once[pair].share < 1.0}
    torn = {pair: found for pair, found in torn.items() if pair not in repeats}
    sure -= torn.keys()
    agreeing = {pair.ids for pair in close if pair.share <= AGREE} & set(matched.matches)
    agreeing -= {*known, *torn} | ambiguous
    votes = _trust(agreeing | sure, {*torn, *known}, matched)
    strongest = _strongest_false({*torn, *known}, matched)
    reasons = {pair: _torn_reason(found) for pair, found in torn.items()}
    reasons |= dict.fromkeys(apart & torn.keys(), _APART)
    for pair, found in votes.items():
        if found.contradicted > found.confirmed:
            reasons[pair] = _contradicted_reason(found, len(matched.matches[pair]))
        elif pair in ambiguous:
            reasons[pair] = _AMBIGUOUS
        elif len(matched.matches[pair]) < STRONGER * max(strongest.get(image, 0) for image in pair):
            reasons[pair] = _UNCONFIRMED
    for pair, reason in reasons.items():
        known[pair] = Doubt(*pair, len(matched.matches[pair]), reason)
    return tuple(known[pair] for pair in sorted(known))


def _strongest_false(false: Iterable[Pair], matched: Matched) -> dict[int, int]:
    """The most features in which each photo agrees with one that it contradicts.

    A false pair agrees in what looks alike, and in most of it where the two look from the same
    side. A pair that agrees in more has more to it: what is beside it agrees, too.
    """
    most: dict[int, int] = {}
    for pair in false:
        for image in pair:
            most[image] = max(most.get(image, 0), len(matched.matches[pair]))
    return most


def contradict(pair: ClosePair) -> bool:
    """Whether two close photos cannot show the same place."""
    return pair.share >= CONFLICT and pair.conflicting >= FEWEST_CONFLICTS


def _trust(agreeing: set[Pair], torn: set[Pair], matched: Matched) -> dict[Pair, Vote]:
    """The votes on all pairs that are not trusted in the end, by the pairs that are."""
    trusted = set(agreeing)
    for _ in range(ROUNDS):
        tracks = chain(matched, trusted)
        asked = sorted(set(matched.matches) - trusted - torn)
        votes = {pair: vote(tracks, pair, matched.matches[pair]) for pair in asked}
        confirmed = {pair for pair, found in votes.items() if _is_confirmed(found)}
        if not confirmed:
            break
        trusted |= confirmed
    return {pair: found for pair, found in votes.items() if pair not in trusted}


def _is_confirmed(found: Vote) -> bool:
    return found.confirmed >= CONFIRMED and found.confirmed > OVERRULED * found.contradicted


_UNCONFIRMED = (
    "nothing confirms it, and one of the two agrees in as many features with a photo that it"
    " contradicts"
)


_APART = "they would stand in one place, but what is around differs"
_AMBIGUOUS = (
    "nearly all of what matches in it is there more than once, and other photos do not confirm it"
)


def _torn_reason(pair: ClosePair) -> str:
    return (
        f"they would be {pair.apart_deg:.0f}° apart, but in {pair.conflicting} of {pair.cells}"
        " parts of the picture each shows what the other lacks"
    )


def _contradicted_reason(found: Vote, count: int) -> str:
    return (
        f"other photos show {found.contradicted} of its {count} matches as two things side by side,"
        f" and confirm {found.confirmed}"
    )


def read_matched(database: Path, image_ids: Sequence[int], fewest: int) -> Matched:
    """The verified matches of the engine's database, of pairs with at least so many."""
    matches = {}
    with pycolmap.Database.open(database) as opened:
        keypoints = {image: opened.read_keypoints(image)[:, :2] for image in image_ids}
        known = set(image_ids)
        pair_ids, counts = opened.read_two_view_geometry_num_inliers()
        for pair_id, count in zip(pair_ids, counts, strict=True):
            first, second = sorted(pycolmap.pair_id_to_image_pair(pair_id))
            if count >= fewest and {first, second} <= known:
                found = opened.read_two_view_geometry(first, second).inlier_matches
                matches[first, second] = np.asarray(found, dtype=np.int64)
    return Matched(
        {image: np.asarray(px, dtype=np.float64) for image, px in keypoints.items()}, matches
    )


def database_without(database: Path, doubts: Iterable[Doubt], target: Path) -> None:
    """A copy of the engine's database without the verified matches of some pairs."""
    with atomic_write(target) as temporary:
        shutil.copyfile(database, temporary)
        with pycolmap.Database.open(temporary) as opened:
            for doubt in doubts:
                geometry = opened.read_two_view_geometry(doubt.first, doubt.second)
                geometry.inlier_matches = np.empty((0, 2), dtype=np.uint32)
                opened.update_two_view_geometry(doubt.first, doubt.second, geometry)


def write_doubts(path: Path, doubts: Sequence[Doubt]) -> None:
    """Keep them; the file appears whole."""
    write_bytes(path, json.dumps([asdict(doubt) for doubt in doubts]).encode())


def read_doubts(path: Path) -> tuple[Doubt, ...]:
    """What `write_doubts` kept."""
    return tuple(Doubt(**entry) for entry in json.loads(path.read_text(encoding="utf-8")))
