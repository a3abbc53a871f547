"""What trusted pairs of photos say of a match of another: they confirm it, or they contradict it.

The matches of trusted pairs chain features of many photos to tracks. A match of another pair whose
two features are on one track is confirmed. One whose features are on two tracks that a single photo
shows in two places is contradicted: a thing is not beside itself. (Zach, Klopschitz and Pollefeys,
Disambiguating visual relations using loop constraints, CVPR 2010, close loops of poses; here the
loops are those of the features, for which no focal length need be known.)
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array, csr_array
from scipy.sparse.csgraph import connected_components

SAME_PX = 4.0
"""Features of a photo that are nearer to each other are one: SIFT gives several of a place."""

Pair = tuple[int, int]


@dataclass(frozen=True)
class Matched:
    """Verified matches: (m, 2) rows of the features of the two photos, by the pair of image ids.

    keypoints_px: (k, 2) of each photo, by its id.
    """

    keypoints_px: Mapping[int, NDArray[np.float64]]
    matches: Mapping[Pair, NDArray[np.int64]]


@dataclass(frozen=True)
class Vote:
    """How many matches of a pair are confirmed, and contradicted; of others nothing is known."""

    confirmed: int
    contradicted: int


@dataclass(frozen=True)
class Tracks:
    """Chains of features. first: of each photo's features in the columns, by its id.

    track_of: (f,) the track of each feature. voting: (t,) those that several photos show, and none
    in two places. places_px: (f, 2) of the features.
    shown: (t, n) 1 + a feature of the track in each photo, 0 where there is none.
    """

    first: Mapping[int, int]
    track_of: NDArray[np.int64]
    voting: NDArray[np.bool_]
    places_px: NDArray[np.float64]
    shown: csr_array


def chain(matched: Matched, trusted: Iterable[Pair]) -> Tracks:
    """The tracks of the trusted pairs' matches."""
    ids = sorted(matched.keypoints_px)
    sizes = [len(matched.keypoints_px[image]) for image in ids]
    starts = np.concatenate([[0], np.cumsum(sizes)])
    first = dict(zip(ids, starts.tolist(), strict=False))
    links = [_columns(first, pair, matched.matches[pair]) for pair in sorted(trusted)]
    ends = np.concatenate([np.empty((0, 2), dtype=np.int64), *links])
    count = int(starts[-1])
    graph = coo_array((np.ones(len(ends), dtype=np.int8), (ends[:, 0], ends[:, 1])), (count, count))
    tracks, labels = connected_components(graph, directed=False)
    track_of = labels.astype(np.int64)
    photo = np.repeat(np.arange(len(ids)), sizes)
    places = np.concatenate([matched.keypoints_px[image] for image in ids])
    # One feature stands for the track in each photo that shows it.
    _, one, group = np.unique(track_of * len(ids) + photo, return_index=True, return_inverse=True)
    torn = np.linalg.norm(places - places[one][group], axis=1) > SAME_PX
    voting = np.bincount(track_of, minlength=tracks) > 1
    voting[track_of[torn]] = False
    one = one[voting[track_of[one]]]
    shown = csr_array((one + 1, (track_of[one], photo[one])), shape=(tracks, len(ids)))
    return Tracks(first, track_of, voting, places, shown)


def vote(tracks: Tracks, pair: Pair, matches: NDArray[np.int64]) -> Vote:
    """What the tracks say of the matches of a pair that did not make them."""
    on = tracks.track_of[_columns(tracks.first, pair, matches)]
    on = on[tracks.voting[on].all(axis=1)]
    same = on[:, 0] == on[:, 1]
    here, there = (tracks.shown[on[~same, side]] for side in (0, 1))
    # Both have an entry exactly where a photo shows the two tracks, in the same order.
    first, second = (
        one.multiply(other.astype(bool)).tocsr().sorted_indices()
        for one, other in ((here, there), (there, here))
    )
    apart_px = np.linalg.norm(
        tracks.places_px[first.data - 1] - tracks.places_px[second.data - 1], axis=1
    )
    rows = np.repeat(np.arange(first.shape[0]), np.diff(first.indptr))
    against = len(np.unique(rows[apart_px > SAME_PX]))
    return Vote(int(same.sum()), against)


def _columns(first: Mapping[int, int], pair: Pair, matches: NDArray[np.int64]) -> NDArray[np.int64]:
    """(m, 2) the matched features, numbered through all photos."""
    numbers: NDArray[np.int64] = matches + np.array([first[pair[0]], first[pair[1]]])
    return numbers
