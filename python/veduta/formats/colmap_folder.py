"""The files of a COLMAP model that is given: found, whole, and read."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from types import ModuleType

from veduta.formats import colmap_binary, colmap_text
from veduta.formats.colmap_model import NAMES, ColmapModel, checked_model
from veduta.run.digests import file_digest
from veduta.run.errors import InputError
from veduta.run.inputs import require_file

LARGEST_BYTES = {".bin": 4_000_000_000, ".txt": 1_000_000_000}
"""Of a file, which is read whole: 20,000 photos with 8,192 features each have 3.9 GB in
`images.bin`."""
_READERS: dict[str, ModuleType] = {".bin": colmap_binary, ".txt": colmap_text}
_REMEDY = (
    "Name a folder with cameras, images and points3D (.bin or .txt), such as sparse/0, or sparse"
    " with such folders in it."
)


@dataclass(frozen=True)
class ModelFiles:
    """A component's files, in the order of `NAMES`, and their digests."""

    paths: tuple[Path, ...]
    sha256: tuple[str, ...]


def models_in(folder: Path) -> tuple[ModelFiles, ...]:
    """The model of a folder, or those of the numbered folders in it or in its `sparse`.

    InputError names the file that is missing.
    """
    if not folder.is_dir():
        fault = "is a file, not a folder" if folder.exists() else "does not exist"
        raise InputError(folder, fault, _REMEDY)
    for place in (folder, folder / "sparse"):
        if _suffix(place):
            return (_files(place),)
        numbered = [path for path in place.glob("*") if path.name.isdigit() and path.is_dir()]
        if numbered:
            numbered.sort(key=lambda path: int(path.name))
            return tuple(_files(path) for path in numbered)
    raise InputError(folder, "holds no COLMAP model", _REMEDY)


def read_model(files: ModelFiles) -> ColmapModel:
    """What the files say; InputError names the one that is damaged."""
    cameras, images, points = files.paths
    reader = _READERS[cameras.suffix]
    model = ColmapModel(
        reader.read_cameras(cameras, cameras.read_bytes()),
        reader.read_images(images, images.read_bytes()),
        reader.read_points(points, points.read_bytes()),
    )
    return checked_model(images, model)


def _suffix(folder: Path) -> str | None:
    """The kind of files that most of the three are there of; binary ones come first."""
    there = {
        suffix: sum((folder / f"{name}{suffix}").exists() for name in NAMES) for suffix in _READERS
    }
    best = max(there, key=lambda suffix: there[suffix])
    return best if there[best] else None


def _files(folder: Path) -> ModelFiles:
    suffix = _suffix(folder)
    if suffix is None:
        raise InputError(folder, "holds no COLMAP model", _REMEDY)
    paths = tuple(folder / f"{name}{suffix}" for name in NAMES)
    digests = []
    for path in paths:
        try:
            require_file(path, LARGEST_BYTES[suffix])
            digests.append(file_digest(path))
        except FileNotFoundError:
            others = ", ".join(other.name for other in paths if other.exists())
            remedy = f"Copy it to where the others lie ({others})."
            raise InputError(path, "is missing", remedy) from None
        except OSError as error:
            fault = f"cannot be read ({error.strerror})"
            raise InputError(path, fault, "Check its permissions.") from error
    return ModelFiles(paths, tuple(digests))
