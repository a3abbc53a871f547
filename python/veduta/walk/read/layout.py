"""Which files of a folder are the left and the right pictures of which key position."""

from __future__ import annotations

import re
from pathlib import Path

from veduta.imaging.read import SUFFIXES
from veduta.run.errors import InputError
from veduta.walk.rig import PairFiles

SIDES = (("left", "right"), ("image_2", "image_3"), ("image_l", "image_r"), ("image_0", "image_1"))
VIEWS = "views"
MOST_PAIRS = 20_000
REMEDY = (
    "Give a folder with left/ and right/ (or image_2/ and image_3/, image_l/ and image_r/), or with"
    " views/KEY/VIEW_left.* and VIEW_right.*."
)


def find_pairs(folder: Path) -> list[PairFiles]:
    """All pairs below a folder, in the order of their names; InputError where there are none."""
    if not folder.is_dir():
        raise InputError(folder, "there is no such folder", REMEDY)
    pairs = _views(folder / VIEWS) if (folder / VIEWS).is_dir() else _sides(folder)
    if len(pairs) > MOST_PAIRS:
        raise InputError(folder, f"holds {len(pairs)} pairs", f"At most {MOST_PAIRS} make a walk.")
    return pairs


def _sides(folder: Path) -> list[PairFiles]:
    for left, right in SIDES:
        if (folder / left).is_dir() and (folder / right).is_dir():
            return _of_two_folders(folder / left, folder / right)
    half = [name for pair in SIDES for name in pair if (folder / name).is_dir()]
    fault = f"holds {half[0]}/ alone" if half else "holds no folders of left and right pictures"
    raise InputError(folder, fault, REMEDY)


def _of_two_folders(left: Path, right: Path) -> list[PairFiles]:
    lefts, rights = _pictures(left), _pictures(right)
    if not lefts:
        raise InputError(left, "holds no pictures", REMEDY)
    pairs = []
    for stem, path in lefts.items():
        if stem not in rights:
            raise InputError(
                right / path.name, "the right picture of a pair is missing",
                f"Add it, or take {path} away.",
            )  # fmt: skip
        pairs.append(PairFiles(stem, "0", path, rights[stem]))
    alone = sorted(set(rights) - set(lefts), key=_natural)
    if alone:
        raise InputError(
            left / rights[alone[0]].name, "the left picture of a pair is missing",
            f"Add it, or take {rights[alone[0]]} away.",
        )  # fmt: skip
    return pairs


def _views(folder: Path) -> list[PairFiles]:
    pairs = []
    for key in sorted(
        (one for one in folder.iterdir() if one.is_dir()), key=lambda p: _natural(p.name)
    ):
        pictures = _pictures(key)
        for stem, path in pictures.items():
            if not stem.endswith("_left"):
                continue
            view = stem.removesuffix("_left")
            right = pictures.get(f"{view}_right")
            if right is None:
                raise InputError(
                    key / f"{view}_right{path.suffix}", "the right picture of a pair is missing",
                    f"Add it, or take {path} away.",
                )  # fmt: skip
            pairs.append(PairFiles(key.name, view, path, right))
    if not pairs:
        raise InputError(folder, "holds no pairs VIEW_left.* and VIEW_right.*", REMEDY)
    return pairs


def _pictures(folder: Path) -> dict[str, Path]:
    """By name without suffix, in natural order."""
    files = [one for one in folder.iterdir() if one.suffix.lower() in SUFFIXES and one.is_file()]
    return {one.stem: one for one in sorted(files, key=lambda p: _natural(p.stem))}


def _natural(name: str) -> list[tuple[int, int, str]]:
    """Numbers in a name count as numbers: 9 before 10."""
    parts = re.findall(r"\d+|\D+", name)
    return [(0, int(part), "") if part.isdigit() else (1, 0, part) for part in parts]
