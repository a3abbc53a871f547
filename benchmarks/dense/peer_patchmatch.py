"""The PatchMatch of pyarchinit-photogrammetry-core on the views of an .npz; run by its own Python.

python peer_patchmatch.py GIVEN FOUND. GIVEN: grey (n, h, w) 0 to 1, poses (n, 4, 4), k (4,), depths
(2,). FOUND: depths (n, h, w), 0 where unknown.
"""

import sys

import numpy as np
import ppg_core  # type: ignore[import-not-found]

given = np.load(sys.argv[1])
poses, k = given["poses"], tuple(float(one) for one in given["k"])
found = []
for view, pose in enumerate(poses):
    sources = []
    for other in sorted(range(len(poses)), key=lambda one: abs(one - view))[1:5]:
        moved = poses[other] @ np.linalg.inv(pose)
        picture = np.ascontiguousarray(given["grey"][other], dtype=np.float32)
        sources.append((picture, k, moved[:3, :3].copy(), moved[:3, 3].copy()))
    reference = np.ascontiguousarray(given["grey"][view], dtype=np.float32)
    near, far = (float(one) for one in given["depths"])
    depth = ppg_core.patchmatch_depth(reference, k, sources, (near, far))[0]
    found.append(np.asarray(depth, dtype=np.float32))
np.savez_compressed(sys.argv[2], depths=np.stack(found))
