"""The path of a 3D scanner without poses: each scan onto the ones before it (small-gicp)."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import small_gicp
from numpy.typing import NDArray

from veduta.run.errors import NotFoundError


@dataclass(frozen=True)
class RegistrationParameters:
    """Thresholds of registration.

    voxel_m: points are thinned to this. apart_m: points farther apart do not match.
    first_apart_m: for a start of which nothing is known. fewest_share: of the thinned points must
    match. longest_m: between two scans; farther is no drive. keep: scans that the map holds.
    """

    voxel_m: float = 0.3
    apart_m: float = 1.0
    first_apart_m: float = 3.0
    fewest_share: float = 0.3
    longest_m: float = 6.0
    keep: int = 5
    threads: int = 2


@dataclass(frozen=True, eq=False)
class Chain:
    """world_from_sensor: (s, 4, 4), the first is the identity. share: (s,) of points that match."""

    world_from_sensor: NDArray[np.float64]
    share: NDArray[np.float64]


def register_scans(
    reads: Sequence[Callable[[], NDArray[np.float64]]],
    names: Sequence[str],
    parameters: RegistrationParameters | None = None,
) -> Chain:
    """GICP of each scan against the last few, from where the motion so far leads.

    NotFoundError where a scan matches none: nothing is guessed across a break.
    """
    chosen = parameters or RegistrationParameters()
    places = [np.eye(4)]
    shares = [1.0]
    recent = [_thinned(reads[0](), chosen)]
    motion = np.eye(4)
    for row in range(1, len(reads)):
        scan = _thinned(reads[row](), chosen)
        target = np.concatenate([
            cloud @ place[:3, :3].T + place[:3, 3]
            for cloud, place in zip(recent, places[-len(recent):], strict=True)
        ])  # fmt: skip
        start = places[-1] @ motion
        apart = chosen.first_apart_m if row == 1 else chosen.apart_m
        result = small_gicp.align(
            target, scan, init_T_target_source=start, registration_type="GICP",
            downsampling_resolution=chosen.voxel_m, max_correspondence_distance=apart,
            num_threads=chosen.threads, max_iterations=60,
        )  # fmt: skip
        if row == 1:
            result = small_gicp.align(
                target, scan, init_T_target_source=result.T_target_source,
                registration_type="GICP", downsampling_resolution=chosen.voxel_m,
                max_correspondence_distance=chosen.apart_m, num_threads=chosen.threads,
                max_iterations=60,
            )  # fmt: skip
        place = np.asarray(result.T_target_source, dtype=np.float64)
        share = result.num_inliers / max(len(scan), 1)
        moved = float(np.linalg.norm(place[:3, 3] - places[-1][:3, 3]))
        if share < chosen.fewest_share or moved > chosen.longest_m:
            evidence = f"scan {names[row]} matches the one before in {100 * share:.0f} % of points"
            raise NotFoundError("the path", evidence, "Leave out what lies beyond a break.")
        motion = np.linalg.inv(places[-1]) @ place
        places.append(place)
        shares.append(share)
        recent = [*recent, scan][-chosen.keep :]
    return Chain(np.stack(places), np.array(shares))


def _thinned(points: NDArray[np.float64], chosen: RegistrationParameters) -> NDArray[np.float64]:
    thin = small_gicp.voxelgrid_sampling(points, chosen.voxel_m, num_threads=chosen.threads)
    return np.asarray(thin.points()[:, :3], dtype=np.float64)
